"""How far vertices deviate from a smooth surface: noise, and the steps of voxels."""

from math import comb

import numpy as np

from curvlib.kit.disk import MOST

from .mesh import Mesh
from .neighbourhoods import CLOSED

# Degree and rings of the polynomials. Over two rings they see less of the creases, over three they
# follow more of the shape; the smaller deviation is the better bound.
FITS = ((3, 2), (6, 3))
SAMPLES = 400  # vertices, evenly spaced in their order
LEAST = 20  # fits
SPARE = 4  # neighbours more than coefficients

# A staircase deviates by at least so many mean edges, and has at most so many different edges,
# both ways: those of half a step in each coordinate are 124.
STEP = 0.02
DIFFERENT = 124
EDGES = 20000
# Edges are compared by multiples of these parts of a mean edge: one that lies between two multiples
# of the first does not of another.
GRAINS = 0.01, 0.0113, 0.0129


def noise(mesh: Mesh) -> float:
    """The standard deviation of the vertices from smooth pieces of surface, in mean edges: that of
    noise across the surface, or an upper bound where the pieces do not follow its shape.

    Notes
    -----
    The median, over vertices, of the residual variance of polynomials. White noise from 0.001 to
    0.1 edges is told to a fifth; clean meshes of 50 x 50 vertices have some 1e-5. NaN: needs 20
    vertices with two closed rings.
    """
    return min((_deviation(mesh, *fit) for fit in FITS), key=lambda x: (x != x, x))


def staircase(edges: np.ndarray, noise: float) -> bool:
    """Whether edges (E, 3), as vectors, are steps of a lattice across a surface, as those of voxels
    are, turned or not; `noise` as that function returns it. Of an even CAD model they may be few,
    but there is no noise."""
    if not noise >= STEP:
        return False
    some = edges[:: 1 + len(edges) // EDGES]
    steps = np.vstack((some, -some)) / np.sqrt((some * some).sum(1)).mean()
    different = min(len(np.unique(np.round(steps / grain), axis=0)) for grain in GRAINS)
    return different <= DIFFERENT and len(steps) >= 10 * different


def _deviation(mesh, degree, rings):
    count, variances = comb(degree + 2, 2), []
    powers = [(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]
    for near in _neighbourhoods(mesh, rings):
        spare = len(near) - count
        if not SPARE <= spare <= MOST:
            continue
        points = mesh.vertices[near] * mesh.unit
        points = points - points.mean(0)
        height, y, x = (points @ np.linalg.eigh(points.T @ points)[1]).T
        scale = np.hypot(x, y).max()
        if not scale > 0:
            continue
        terms = np.stack([(x / scale) ** i * (y / scale) ** j for i, j in powers], 1)
        basis = np.linalg.qr(terms)[0]
        residual = height - basis @ (basis.T @ height)
        # The median of chi^2 / spare, by Wilson and Hilferty.
        variances.append(residual @ residual / spare / (1 - 2 / (9 * spare)) ** 3)
    if len(variances) < LEAST:
        return np.nan
    return float(np.sqrt(np.median(variances)) / (mesh.mean_edge * mesh.unit))


def _neighbourhoods(mesh, rings):
    """Yield the vertices within some rings of SAMPLES vertices, where all are closed."""
    offsets, neighbours, stars, _ = mesh.find_adjacency()
    closed = np.flatnonzero(stars == CLOSED)
    at = np.unique(np.linspace(0, len(closed) - 1, SAMPLES).astype(int)) if len(closed) else []
    for v in closed[at].tolist():
        near, front = {v}, [v]
        for _ in range(rings):
            if (stars[front] != CLOSED).any():
                near = None
                break
            row = [neighbours[offsets[u] : offsets[u + 1]] for u in front]
            front = sorted({*np.concatenate(row).tolist()} - near) if row else []
            near |= {*front}
        if near:
            yield np.array(sorted(near))
