"""What a library returns, turned to pointwise values at the vertices of a mesh."""

import numpy as np

from curvlib.kit.tensor import Curvatures


def over_used(returned, mesh, **options):
    """What `returned` returns for the vertices that have triangles, with NaN at the others."""
    used = np.zeros(len(mesh.vertices), dtype=bool)
    used[mesh.faces] = True
    index = np.cumsum(used) - 1
    for values in returned(mesh.vertices[used], index[mesh.faces], **options):
        if values is None:
            yield None
        else:
            every = np.full((len(used), *values.shape[1:]), np.nan)
            every[used] = values
            yield every


def where_closed(mesh, *values):
    """The values, NaN where the triangles do not close to one ring; None is left."""
    return tuple(None if x is None else np.where(mesh.closed, x, np.nan) for x in values)


def of_defects(returned, mesh):
    """K and no H of `returned` angle defects: over the barycentric cell, NaN where the triangles
    close to no ring."""
    K, _ = over_used(returned, mesh)
    return where_closed(mesh, K / cells(mesh), None)


def cells(mesh):
    """Area of each vertex's barycentric cell, (V,): a third of that of its triangles."""
    a, b, c = mesh.vertices[mesh.faces].swapaxes(0, 1)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    return per_vertex(mesh.faces, areas / 3, len(mesh.vertices))


def normals(vertices, faces):
    """Sum of the normals of each vertex's triangles times twice their areas, (V, 3)."""
    a, b, c = vertices[faces].swapaxes(0, 1)
    crosses = np.cross(b - a, c - a)
    return np.stack([per_vertex(faces, x, len(vertices)) for x in crosses.T], axis=1)


def per_vertex(faces, values, count):
    """Sum of the triangles' values (F,) at each of `count` vertices."""
    return np.bincount(faces.ravel(), np.repeat(values, 3), count)


def six(mesh, k1, k2, d1, d2):
    """Curvatures of k1 >= k2 and their directions (V, 3), NaN where these are zero; d2 is turned
    so that (d1, d2, n) is right-handed."""
    n = normals(mesh.vertices, mesh.faces)
    turn = np.copysign(1, (np.cross(d1, d2) * n).sum(1))
    lengths = [np.linalg.norm(d, axis=1) for d in (d1, d2)]
    d1, d2 = d1.T / lengths[0], d2.T / lengths[1] * turn
    return Curvatures(k1 * k2, (k1 + k2) / 2, k1, k2, d1, d2)
