"""What noise of the vertices does to `ball_regression`, on a plane of equilateral triangles."""

from functools import lru_cache

import numpy as np

from .ball_regression import INNER

# Radii in edges.
RADII = np.geomspace(0.75, 24, 16)
SIX = (1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)  # steps along edges


def variances(edges, radius):
    """Variances of H, and of the second fundamental form across a principal direction, per variance
    of the heights.

    Parameters
    ----------
    edges : (m,)
        Lengths of the edges at the vertices.
    radius : float
        Of the balls.

    Returns
    -------
    H, across : (m,)
        Those of the plane whose edges are as many in a radius; the noise is independent from vertex
        to vertex. Least squares, means of normals and vector areas are linear in the heights, so
        that what noise the regression has is known without any residual of it: these are
        correlated over the balls of which normals are means.
    """
    ratio = np.log(radius / edges)
    return [np.exp(np.interp(ratio, np.log(RADII), np.log(x))) / edges**4 for x in _known()]


@lru_cache(maxsize=1)
def _known():
    return np.array([_on_lattice(radius) for radius in RADII]).T


def _on_lattice(radius):
    """Variances of (a + c) / 2 and (a - c) / 2 of the form [[a, b], [b, c]], edges being 1."""
    reach = int(1.7 * radius + 4)
    steps = np.arange(-reach, reach + 1)
    i, j = np.meshgrid(steps, steps, indexing="ij")
    x, y = i + j / 2, j * np.sqrt(0.75)
    distance = np.hypot(x, y)
    weights = np.maximum(1 - (distance / radius) ** 2, 0)
    if radius <= 1:  # no neighbour: as of the first ring
        weights = 1.0 * (distance < 1.01)
    inner = np.maximum(1 - (distance / (INNER * radius)) ** 2, 0)
    inner[reach, reach] = 1
    inner /= inner.sum()
    near = [(i[k], j[k], inner[k]) for k in zip(*np.nonzero(inner))]
    found = []
    for sign in (1, -1):
        # Back from the form to the normals, the areas that these are means of, and the heights.
        of_normals = np.stack((weights * x, sign * weights * y)) / (weights * x * x).sum() / 2
        of_areas = sum(w * np.roll(of_normals, (a, b), (1, 2)) for a, b, w in near)
        of_heights = np.zeros_like(x)
        for (
            a,
            b,
        ) in SIX:  # the gradient over a vertex's triangles is their sum of edges times heights
            along = ((a + b / 2) * of_areas[0] + b * np.sqrt(0.75) * of_areas[1]) / 3
            of_heights -= np.roll(along, (a, b), (0, 1))
        found.append((of_heights**2).sum())
    return found
