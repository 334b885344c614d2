"""Irregular meshes of surfaces in closed form, with exact values at their vertices: points of a
jittered grid, joined by Delaunay.
"""

import numpy as np

from .level_set import on_level_set
from .mesh import Mesh
from .torus import torus

# Each coordinate of a point of the grid moves by up to this part of a step.
JITTER = 0.35

RADII = 2.0, 0.7
SEMI_AXES = np.array([1.0, 0.8, 0.6])


def jittered(surface: str, n: int, seed: int = 0) -> Mesh:
    """A mesh of n^2 vertices of one of SURFACES, with exact K, H, k1, k2, d1, d2 and normals.

    Parameters
    ----------
    surface : {"torus", "ellipsoid", "patch"}
        Radii 2 and 0.7; semi-axes 1, 0.8 and 0.6; the open graph over [-1, 1]^2 of
        z = 0.5 x^2 - 0.3 y^2 + 0.15 sin(3 x) cos(2 y).
    n : int
    seed : int
        Of the jitter.

    Returns
    -------
    Mesh
    """
    return level_set(*SURFACES[surface](n, seed))


def level_set(vertices, faces, gradient, hessian) -> Mesh:
    """A mesh of a level set of a function that grows outward, with exact values.

    Parameters
    ----------
    vertices : (V, 3)
    faces : (F, 3) int
    gradient : (3, V)
        Of the function, at the vertices.
    hessian : (3, 3, V)

    Returns
    -------
    Mesh
        With exact K, H, k1, k2, d1, d2 and normals.
    """
    return Mesh(vertices, faces, **on_level_set(gradient, hessian))


def graph(n: int, f, seed: int = 0) -> Mesh:
    """A mesh of n^2 vertices of the graph of f(x, y) over [-1, 1]^2, without exact values."""
    u = np.linspace(-1, 1, n)
    x, y = (a.ravel() for a in np.meshgrid(u, u, indexing="ij"))
    inner = (np.abs(x) < 1) & (np.abs(y) < 1)
    moves = np.random.default_rng(seed).uniform(-JITTER, JITTER, (2, len(x)))
    x, y = np.stack((x, y)) + moves * inner * 2 / (n - 1)
    return Mesh(np.column_stack((x, y, f(x, y))), plane(x, y))


def plane(x, y):
    """The Delaunay triangles (F, 3) of points of the plane, counter-clockwise."""
    from scipy.spatial import Delaunay

    faces = Delaunay(np.column_stack((x, y))).simplices
    a, b, c = faces.T
    turned = (x[b] - x[a]) * (y[c] - y[a]) < (x[c] - x[a]) * (y[b] - y[a])
    faces[turned] = faces[turned, ::-1]
    return faces


def wavy(x, y):
    """The height of the patch."""
    return 0.5 * x * x - 0.3 * y * y + 0.15 * np.sin(3 * x) * np.cos(2 * y)


def _patch(n, seed):
    """The level set of z - wavy(x, y)."""
    mesh = graph(n, wavy, seed)
    x, y, _ = mesh.vertices.T
    sine, cosine = 0.15 * np.sin(3 * x), 0.15 * np.cos(3 * x)
    p = x + 3 * cosine * np.cos(2 * y)
    q = -0.6 * y - 2 * sine * np.sin(2 * y)
    r = 1 - 9 * sine * np.cos(2 * y)
    s = -6 * cosine * np.sin(2 * y)
    t = -0.6 - 4 * sine * np.cos(2 * y)
    zero = 0 * x
    hessian = np.stack([[-r, -s, zero], [-s, -t, zero], [zero, zero, zero]])
    return mesh.vertices, mesh.faces, np.stack((-p, -q, zero + 1)), hessian


def _torus(n, seed):
    """The level set of (|(x, y)| - R)^2 + z^2."""
    vertices, faces = torus(n, "irregular", seed, RADII, JITTER)
    x, y, z = vertices.T
    around = np.hypot(x, y)
    c, s, zero, g = x / around, y / around, 0 * z, 2 * (around - RADII[0])
    along = g / around  # of the second derivative along the circle about the axis
    xy = (2 - along) * c * s
    hessian = [
        [2 * c * c + along * s * s, xy, zero],
        [xy, 2 * s * s + along * c * c, zero],
        [zero, zero, zero + 2],
    ]
    return vertices, faces, np.stack((g * c, g * s, 2 * z)), np.stack(hessian)


def _ellipsoid(n, seed):
    """The level set of |(x / a, y / b, z / c)|^2: a stretched sphere."""
    points = spiral(n, seed)
    faces = hull(points)
    hessian = np.broadcast_to(np.diag(2 / SEMI_AXES**2)[..., None], (3, 3, len(points)))
    return points * SEMI_AXES, faces, 2 * (points / SEMI_AXES).T, np.ascontiguousarray(hessian)


def spiral(n: int, seed: int = 0):
    """n^2 points (n^2, 3) of the unit sphere on a spiral, evenly spaced, then jittered."""
    count = n * n
    z = 1 - (2 * np.arange(count) + 1) / count
    turn = np.pi * (3 - np.sqrt(5)) * np.arange(count)
    ring = np.sqrt(1 - z * z)
    points = np.column_stack((ring * np.cos(turn), ring * np.sin(turn), z))
    step = np.sqrt(4 * np.pi / count)
    points += step * np.random.default_rng(seed).uniform(-JITTER, JITTER, points.shape)
    return points / np.linalg.norm(points, axis=1)[:, None]


def hull(points):
    """The Delaunay triangles (F, 3) of points on the unit sphere: their convex hull."""
    from scipy.spatial import ConvexHull

    faces = ConvexHull(points).simplices.astype(np.int64)
    inward = np.linalg.det(points[faces]) < 0
    faces[inward] = faces[inward, ::-1]
    return faces


SURFACES = {"torus": _torus, "ellipsoid": _ellipsoid, "patch": _patch}
