"""A torus of any resolution, for measurements and tests."""

import numpy as np


def torus(side: int, kind: str, seed: int = 0, radii=(2.0, 1.0), jitter: float = 0.45):
    """Vertices (side^2, 3) and faces of a torus: a grid in its angles for "regular", the Delaunay
    triangles of the grid, jittered by part of a step, for "irregular"."""
    i, j = np.divmod(np.arange(side * side), side)
    points = np.stack((i, j), -1).astype(float)
    if kind == "irregular":
        points += np.random.default_rng(seed).uniform(-jitter, jitter, points.shape)
    angles = 2 * np.pi / side * points
    around, ring = np.cos(angles), np.sin(angles)
    r = radii[0] + radii[1] * around[:, 1]
    vertices = np.stack((r * around[:, 0], r * ring[:, 0], radii[1] * ring[:, 1]), -1)
    return vertices, (_grid if kind == "regular" else _delaunay)(points, side)


def _grid(points, side):
    i, j = points.astype(int).T
    a, b, c, d = (
        (i + di) % side * side + (j + dj) % side for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1))
    )
    return np.stack((a, b, c, a, c, d), -1).reshape(-1, 3)


def _delaunay(points, side):
    from scipy.spatial import Delaunay

    # Periodic Delaunay: triangulate the points with a margin of copies, and keep of each
    # triangle's copies the one whose centre lies in the period.
    cell = np.stack(np.meshgrid(*[np.arange(-3, side + 3)] * 2, indexing="ij"), -1).reshape(-1, 2)
    index = cell % side @ (side, 1)
    copies = points[index] + cell - cell % side
    triangles = Delaunay(copies).simplices
    centre = copies[triangles].mean(1)
    triangles = triangles[((centre >= 0) & (centre < side)).all(1)]
    p, q = (copies[triangles[:, k]] - copies[triangles[:, 0]] for k in (1, 2))
    turned = p[:, 0] * q[:, 1] < p[:, 1] * q[:, 0]
    triangles[turned] = triangles[turned, ::-1]
    return index[triangles].astype(np.int64)
