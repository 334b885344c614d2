"""Exact curvature at the nearest point of an implicit surface."""

import numpy as np

from curvlib.catalogue import implicit
from curvlib.meshes.level_set import on_level_set
from curvlib.meshes.mesh import Mesh

SWEEPS, APPROACHES = 30, 6
# A point is on the surface where Newton's step is below this part of the size of the box.
CLOSE = 1e-12
# Longest step along gradients, in parts of that size: longer ones would cross the surface.
LONGEST = 0.1


def symmetric(xx, yy, zz, xy, xz, yz):
    """Hessians (3, 3, m) from second derivatives, arrays (m,) or numbers."""
    rows = np.broadcast_arrays(xx, xy, xz, xy, yy, yz, xz, yz, zz)
    return np.stack(rows).reshape(3, 3, -1).astype(float)


def nearest(surface: str, points, along=None):
    """The nearest points of a surface.

    Parameters
    ----------
    surface : str
        A name or path of `curvlib.catalogue.implicit`.
    points : ndarray, (m, 3)
        Nearer to the surface than its centres of curvature.
    along : ndarray, (m, 3), optional
        Directions; then the points of the surface on lines through `points` along them.

    Returns
    -------
    ndarray, (m, 3)
        NaN where none is found.

    Notes
    -----
    Newton's method for x - p + t grad f(x) = 0 and f(x) = 0, after some steps in the tangent plane
    from the point that is reached along gradients.
    """
    module = implicit.module(surface)
    p, size = np.ascontiguousarray(np.asarray(points, float).T), max(module.BOX)
    lines = None if along is None else np.asarray(along, float).T
    foot, step = _root(module, p, lines, size)
    if lines is not None:
        return np.where(_found(module, foot, step, size), foot, np.nan).T
    x = foot
    for _ in range(APPROACHES):
        _, g, _ = module.level(*x)
        with np.errstate(divide="ignore", invalid="ignore"):
            n = np.nan_to_num(g / np.linalg.norm(g, axis=0))
        x, _ = _root(module, p - ((p - x) * n).sum(0) * n, None, size)
    x, step = _perpendicular(module, p, x, size)
    # Newton's method may have gone to another point, which is not nearer than where it started.
    reached, first = np.linalg.norm(x - p, axis=0), np.linalg.norm(foot - p, axis=0)
    nearer = reached <= first + 1e3 * CLOSE * size
    return np.where(_found(module, x, step, size) & nearer, x, np.nan).T


def _found(module, x, step, size):
    """Whether the last step was small and led to the surface."""
    f, g, _ = module.level(*x)
    on = np.abs(f) < 1e3 * CLOSE * size * np.linalg.norm(g, axis=0)
    return on & (np.abs(step).max(0) < 1e3 * CLOSE * size)


def _root(module, x, lines, size):
    """Points of the surface along lines, or along gradients, from x (3, m), and the last step."""
    for _ in range(SWEEPS):
        f, g, _ = module.level(*x)
        direction = g if lines is None else lines
        with np.errstate(divide="ignore", invalid="ignore"):
            step = np.nan_to_num(f / (direction * g).sum(0) * direction)
            step = step * np.minimum(1, LONGEST * size / np.linalg.norm(step, axis=0))
        step = np.nan_to_num(step)
        x = x - step
        if np.abs(step).max(initial=0) < CLOSE * size:
            break
    return x, step


def _perpendicular(module, p, x, size):
    """Points of the surface near x from which p lies along the gradient, and the last step."""
    f, g, _ = module.level(*x)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = np.nan_to_num(((p - x) * g).sum(0) / (g * g).sum(0))
    step = np.zeros((4, x.shape[1]))
    for _ in range(SWEEPS):
        f, g, hessian = module.level(*x)
        matrix = np.zeros((x.shape[1], 4, 4))
        matrix[:, :3, :3] = np.eye(3) + (t * hessian).transpose(2, 0, 1)
        matrix[:, :3, 3] = matrix[:, 3, :3] = g.T
        right = np.concatenate([x - p + t * g, f[None]]).T
        with np.errstate(all="ignore"):
            regular = np.abs(np.linalg.det(matrix)) > 0
        matrix[~regular] = np.eye(4)
        step = -np.linalg.solve(matrix, right[..., None])[..., 0].T
        x, t = x + step[:3], t + step[3]
        if np.abs(step[:3]).max(initial=0) < CLOSE * size:
            break
    return x, step[:3]


def exact(surface: str, points) -> dict:
    """The fields of a Mesh, as `on_level_set` returns them, at points (V, 3) of a surface; `smooth`
    is False, and the others are NaN, where a point is NaN."""
    points = np.asarray(points, float)
    known = np.isfinite(points).all(1)
    _, gradient, hessian = implicit.module(surface).level(*np.where(known[:, None], points, 1).T)
    fields = on_level_set(gradient, hessian)
    for values in fields.values():
        values[~known] = np.nan
    return fields | {"smooth": known}


def exact_mesh(surface: str, vertices, faces) -> Mesh:
    """A mesh with exact values at the points of the surface that are nearest to its vertices.

    Normals are the surface's there. Vertices without such a point have NaN, and are not `smooth`.
    """
    return Mesh(vertices, faces, **exact(surface, nearest(surface, vertices)))


def on_surface(surface: str, vertices, faces) -> Mesh:
    """A mesh whose vertices are moved to the nearest points of the surface, with exact values
    there."""
    points = nearest(surface, vertices)
    vertices = np.where(np.isfinite(points), points, vertices)
    return Mesh(vertices, faces, **exact(surface, points))
