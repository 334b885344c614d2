"""The triangles of a mesh as points: centres, normals, areas, and which triangles touch."""

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.disk import MOST

from .neighbourhoods import BROKEN, CLOSED


def facets(mesh, threads: int = 1):
    """The graph of a mesh's triangles: two are neighbours if they share a vertex whose triangles
    form a disk or half-disk of at most MOST of them: n at one vertex have n^2 pairs.

    Returns
    -------
    centres, normals : (F, 3)
        In the unit of the mesh; unit normals, NaN where a triangle has no area.
    areas : (F,)
        In the square of the unit of disks (`Mesh.unit`).
    offsets : (F + 1,) int64
    neighbours : (offsets[F],) int32
        Of triangle f neighbours[offsets[f] : offsets[f + 1]], in ascending order.
    stars : (F,) uint8
        CLOSED for a triangle with an area, else BROKEN.
    """
    corners = mesh.vertices[mesh.faces]
    centres = corners[:, 0] / 3 + corners[:, 1] / 3 + corners[:, 2] / 3
    a, b, c = (corners * mesh.unit).transpose(1, 0, 2)
    with np.errstate(invalid="ignore", divide="ignore"):
        normals = np.cross(b - a, c - a)
        lengths = np.sqrt((normals * normals).sum(1))
        normals /= lengths[:, None]
    stars = np.where(lengths > 0, CLOSED, BROKEN).astype(np.uint8)
    # Faces that name a vertex twice, or meet where no disk is, are passed over.
    few = np.bincount(mesh.faces.ravel(), minlength=len(mesh.vertices)) <= MOST
    passed = few & (mesh.find_adjacency(threads).stars != BROKEN)
    corner = np.where(passed[mesh.faces], mesh.faces, -1)
    corner[stars == BROKEN] = -1
    order = np.argsort(corner.ravel(), kind="stable")
    vertex, face = corner.ravel()[order], (order // 3).astype(np.int32)
    begin = np.searchsorted(vertex, np.arange(len(mesh.vertices) + 1))
    offsets = np.zeros(len(corner) + 1, np.int64)
    _touching(corner, begin, face, offsets, np.empty(0, np.int32))
    offsets.cumsum(out=offsets)
    neighbours = np.empty(offsets[-1], np.int32)
    _touching(corner, begin, face, offsets, neighbours)
    return centres, normals, lengths / 2, offsets, neighbours, stars


@compiled
def _touching(corner, begin, face, offsets, neighbours):
    """Set `neighbours`, ordered by index in each row; where there is no memory for them, set
    offsets[f + 1] to the number in row f."""
    for f in range(len(corner)):
        count, first = 0, offsets[f]
        for k in range(3):
            v = corner[f, k]
            if v < 0:
                continue
            for j in range(begin[v], begin[v + 1]):
                other = face[j]
                # A neighbour across an edge has two corners in common: the first counts.
                known = other == f
                for i in range(k):
                    u = corner[f, i]
                    if u >= 0 and (
                        corner[other, 0] == u or corner[other, 1] == u or corner[other, 2] == u
                    ):
                        known = True
                if known:
                    continue
                if len(neighbours) > 0:
                    at = first + count
                    while at > first and neighbours[at - 1] > other:
                        neighbours[at] = neighbours[at - 1]
                        at -= 1
                    neighbours[at] = other
                count += 1
        if len(neighbours) == 0:
            offsets[f + 1] = count
