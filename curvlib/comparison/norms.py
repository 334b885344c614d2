"""Error norms of estimates on one mesh, and which vertices they are taken over."""

import numpy as np

from curvlib.meshes.mesh import Mesh
from curvlib.nurbs.surface import Surface

NORMS = ("mean", "q95", "max", "mean-signed")

# Which vertices count, a choice that no estimator makes: the default first.
VERTICES = ("interior", "without-poles")

# Errors below this fraction of the surface's curvature (largest k^2 for K, k for H) are rounding.
ROUNDING = 1e-9


def error_rows(exact, estimates, counted):
    """Yield a dict with quantity, norm, value, vertices and undefined for each norm.

    The error of K is |K - K_est|, that of H | |H| - |H_est| | as in the paper, blind to sign;
    the norm `mean-signed` is the mean of |H - H_est|. Of the vertices in `counted` (V,) bool,
    `vertices` have exact value and estimate both defined, `undefined` have not. A quantity
    without any estimate has no rows.
    """
    for quantity in ("K", "H"):
        a, b = getattr(exact, quantity), getattr(estimates, quantity)
        defined = np.isfinite(a) & np.isfinite(b) & counted
        if not defined.any():
            continue
        a, b = a[defined], b[defined]
        signed = np.abs(a - b)
        error = signed if quantity == "K" else np.abs(np.abs(a) - np.abs(b))
        values = (error.mean(), np.quantile(error, 0.95), error.max(), signed.mean())
        count = {"vertices": int(defined.sum()), "undefined": int((counted & ~defined).sum())}
        for norm, value in zip(NORMS, values):
            yield {"quantity": quantity, "norm": norm, "value": float(value), **count}


def counted_vertices(mesh: Mesh, surface: Surface) -> dict:
    """The choices of vertices, (V,) bool each: `interior` is all (the boundary has no estimate
    anyway), `without-poles` leaves out poles and their one-rings; only where there is a pole."""
    everywhere = np.ones(len(mesh.vertices), dtype=bool)
    poles = np.zeros_like(everywhere)
    for axis in (0, 1):
        for end in (0, -1):
            if surface.has_pole(axis, end):
                poles |= mesh.uv[:, axis] == surface.domain[axis][end]
    if not poles.any():
        return dict(zip(VERTICES, (everywhere,)))
    near = np.zeros_like(poles)
    near[mesh.faces[poles[mesh.faces].any(1)]] = True
    return dict(zip(VERTICES, (everywhere, ~near)))


def largest_curvature(mesh: Mesh) -> float:
    """The largest |k| at the vertices: the scale of the surface's curvature."""
    return float(np.nanmax(np.abs([mesh.k1, mesh.k2])))
