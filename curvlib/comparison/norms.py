"""Error norms of estimates on one mesh, and which vertices they are taken over."""

import numpy as np

from .quantities import QUANTITIES, absolute

NORMS = ("mean", "q95", "max", "mean-signed")

# Which vertices count, a choice that no estimator makes: the default first.
VERTICES = ("interior", "without-poles")

# Errors below this fraction of the surface's curvature (largest k^2 for K, k for H) are rounding.
ROUNDING = 1e-9


def error_rows(exact, estimates, counted):
    """Yield a dict per quantity: its error in each of NORMS, `vertices` and `undefined`.

    The norms are those of the quantity's own error, |K - K_est| and | |H| - |H_est| | as in the
    paper; `mean-signed` is the mean of |x - x_est|, an absolute error too, but one that sees a
    wrong sign. Of the vertices in `counted` (V,) bool, `vertices` have exact value and estimate
    both defined, `undefined` have not; norms over no vertex are NaN.
    """
    for name, quantity in QUANTITIES.items():
        a, b = getattr(exact, name), getattr(estimates, name)
        defined = np.isfinite(a) & np.isfinite(b) & counted
        a, b = a[defined], b[defined]
        error, values = quantity.error(a, b), np.full(len(NORMS), np.nan)
        if defined.any():
            values = error.mean(), np.quantile(error, 0.95), error.max(), absolute(a, b).mean()
        count = {"vertices": int(defined.sum()), "undefined": int((counted & ~defined).sum())}
        yield {"quantity": name, **dict(zip(NORMS, map(float, values))), **count}


def counted_vertices(mesh) -> dict:
    """The choices of vertices of a Mesh, (V,) bool each: `interior` is all (the boundary has no
    estimate anyway), `without-poles` leaves out poles and their one-rings; only where there is a
    pole."""
    everywhere = np.ones(len(mesh.vertices), dtype=bool)
    if not mesh.pole.any():
        return dict(zip(VERTICES, (everywhere,)))
    near = np.zeros_like(everywhere)
    near[mesh.faces[mesh.pole[mesh.faces].any(1)]] = True
    return dict(zip(VERTICES, (everywhere, ~near)))


def largest_curvature(mesh) -> float:
    """The largest |k| at the vertices of a Mesh: the scale of the surface's curvature."""
    return float(np.nanmax(np.abs([mesh.k1, mesh.k2])))


def rounding_level(quantity: str, largest_k: float) -> float:
    """The error of a quantity below which nothing but rounding is left, on a surface whose
    largest |k| is `largest_k`."""
    return ROUNDING * largest_k ** QUANTITIES[quantity].power
