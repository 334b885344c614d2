"""Error norms of estimates on one mesh, and the choices of vertices for them."""

import numpy as np

from .quantities import QUANTITIES, compared, defined

NORMS = ("mean", "median", "q95", "max", "mean-signed")

# Choices of vertices, the default first: a reading of the count, not of an estimator.
VERTICES = ("interior", "without-poles")

# Errors below this fraction of the largest k^2 (for K) or k (for H) of the surface are rounding.
ROUNDING = 1e-9


def error_rows(exact, estimates, counted):
    """Yield a dict per quantity that is `compared`: its error in each of NORMS, `vertices` and
    `undefined`.

    The errors are |K - K_est| and, as in the paper, | |H| - |H_est| |, further |k1 - k1_est|,
    |k2 - k2_est|, and the angle of d1 in degrees, away from umbilics of the surface. `mean-signed`
    is the mean of |x - x_est|, an absolute error that a wrong sign enters. `vertices`: how many of
    `counted` (V,) bool are interior and have both exact value and estimate; `undefined`: how many
    are left out. Boundary vertices are left out for every estimator, so that all compete on the
    same ones. Norms over no vertex are NaN.
    """
    counted_inside = counted & ~exact.boundary
    for name, (a, b) in compared(exact, estimates).items():
        there = defined(a) & defined(b) & counted_inside
        a, b = a[there], b[there]
        error, values = QUANTITIES[name].error(a, b), np.full(len(NORMS), np.nan)
        if there.any():
            median, q95 = np.quantile(error, (0.5, 0.95))
            signed = QUANTITIES[name].distance(a, b).mean()
            values = error.mean(), median, q95, error.max(), signed
        count = {"vertices": int(there.sum()), "undefined": int((counted & ~there).sum())}
        yield {"quantity": name, **dict(zip(NORMS, map(float, values))), **count}


def counted_vertices(mesh) -> dict:
    """The choices of vertices of a Mesh, (V,) bool each: `interior` is all, of which the
    norms leave the boundary out; `without-poles`, on meshes with a pole, has neither poles nor
    their one-rings."""
    everywhere = np.ones(len(mesh.vertices), dtype=bool)
    if not mesh.pole.any():
        return dict(zip(VERTICES, (everywhere,)))
    near = np.zeros_like(everywhere)
    near[mesh.faces[mesh.pole[mesh.faces].any(1)]] = True
    return dict(zip(VERTICES, (everywhere, ~near)))


def largest_curvature(mesh) -> float:
    """The largest |k| at the vertices of a Mesh: the scale of the surface's curvature."""
    return float(np.nanmax(np.abs([mesh.k1, mesh.k2])))


def edge_lengths(mesh):
    """The lengths (F, 3) of the edges of the triangles of a Mesh."""
    ends = mesh.vertices[mesh.faces]
    return np.linalg.norm(ends - np.roll(ends, -1, axis=1), axis=2)


def rounding_level(quantity: str, largest_k: float) -> float:
    """The error of a quantity up to which it is rounding, on a surface with this largest |k|."""
    return ROUNDING * largest_k ** QUANTITIES[quantity].power
