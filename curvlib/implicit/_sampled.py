"""Meshes of an implicit surface as volume data give them: marching cubes and voxels."""

import numpy as np

from curvlib.catalogue import implicit
from curvlib.meshes.mesh import Mesh

from ._exact import exact_mesh


def marching_cubes(surface: str, n: int, seed: int = 0) -> Mesh:
    """Marching cubes over f at the points of a grid, with exact values at the nearest points.

    Parameters
    ----------
    surface : str
        A name or path of `curvlib.catalogue.implicit`.
    n : int
        Cells along the longest side of the box.
    seed : int
        Of the shift of the grid, by up to a cell: no surface lies on its planes by chance.

    Returns
    -------
    Mesh
        Its vertices lie on the cells' edges where f, interpolated, is 0: near to the surface.
    """
    origin, counts, step = _grid(surface, n, seed)
    values = _values(surface, origin, counts, step)
    return _contour(surface, values, 0.0, origin, step)


def voxels(surface: str, n: int, seed: int = 0) -> Mesh:
    """Marching cubes at isovalue 1 over the mask f <= 0, as segmentations are meshed: all vertices
    are centres of voxels inside, on a staircase. Parameters and result as of `marching_cubes`."""
    origin, counts, step = _grid(surface, n, seed)
    inside = (_values(surface, origin, counts, step) <= 0).astype(float)
    return _contour(surface, inside, 1.0, origin, step)


def _grid(surface, n, seed):
    box = np.array(implicit.module(surface).BOX)
    step = 2 * box.max() / n
    counts = np.ceil(2 * box / step).astype(int) + 1
    shift = np.random.default_rng(seed).uniform(-0.5, 0.5, 3) * step
    return -(counts - 1) * step / 2 + shift, counts, step


def _values(surface, origin, counts, step):
    axes = [o + step * np.arange(c) for o, c in zip(origin, counts)]
    points = [x.ravel() for x in np.meshgrid(*axes, indexing="ij")]
    return implicit.module(surface).level(*points)[0].reshape(counts)


def _contour(surface, values, at, origin, step):
    import pyvista

    grid = pyvista.ImageData(dimensions=values.shape, spacing=(step,) * 3, origin=origin)
    found = grid.contour([at], values.ravel(order="F"), method="marching_cubes")
    vertices = np.asarray(found.points, float)
    faces = found.faces.reshape(-1, 4)[:, 1:]
    # Where two values agree with the isovalue, marching cubes leaves triangles without area.
    vertices, index = np.unique(vertices, axis=0, return_inverse=True)
    faces = index.ravel()[faces]
    a, b, c = faces.T
    faces = faces[(a != b) & (b != c) & (c != a)]
    mesh = exact_mesh(surface, vertices, faces)
    corners = vertices[faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    outward = np.nansum(across * mesh.normals[faces[:, 0]])
    return mesh if outward >= 0 else exact_mesh(surface, vertices, faces[:, ::-1])
