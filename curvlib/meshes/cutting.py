"""Meshes cut along edges, each side with vertices of its own."""

import numpy as np

from .mend import Edges, connected
from .mesh import Mesh

# Shares of the area that differ by less are equal.
DIGITS = 6


def cut(mesh: Mesh, edges: np.ndarray) -> tuple[Mesh, np.ndarray]:
    """Cut a mesh along edges.

    Parameters
    ----------
    mesh : Mesh
    edges : ndarray of int, (n, 2)

    Returns
    -------
    cut : Mesh
        With the same triangles in the same order. Where edges part the triangles at a vertex into
        several fans, each has a vertex of its own: the first the old one, others new ones behind
        the old. A vertex at which one edge ends stays whole. Normals are kept, exact values not.
    index : ndarray of int, (V',)
        The old vertex of each.
    """
    count, faces = len(mesh.vertices), np.array(mesh.faces)
    among = np.zeros(count, bool)
    among[edges] = True
    # What names a vertex twice is no triangle.
    proper = (faces != np.roll(faces, 1, axis=1)).all(1)
    some = np.flatnonzero(among[faces].any(1) & proper)
    corners = faces[some].reshape(-1)
    fans = _fans(faces[some], edges)
    # The fans of a vertex, by their first corners.
    places = np.flatnonzero(among[corners])
    _, first, inverse = np.unique(fans[places], return_index=True, return_inverse=True)
    owner = corners[places[first]]
    order = np.lexsort((first, owner))
    extra = np.concatenate(([False], np.diff(owner[order]) == 0)) if len(order) else order > 0
    names = np.empty(len(order), np.intp)
    names[order] = np.where(extra, count + np.cumsum(extra) - 1, owner[order])
    corners[places] = names[inverse.reshape(-1)]
    faces[some] = corners.reshape(-1, 3)
    index = np.concatenate((np.arange(count), owner[order][extra]))
    normals = None if mesh.normals is None else mesh.normals[index]
    parted = Mesh(mesh.vertices[index], faces, copy=False, normals=normals)
    # A length of some edges is that of the whole mesh.
    parted.mean_edge = mesh.mean_edge
    return parted, index


def larger_sides(parted: Mesh, index: np.ndarray) -> np.ndarray:
    """Of the vertices of a cut mesh that one old vertex became the one on the side that is larger:
    (V,) by old vertex.

    By the area of the connected piece of the mesh, then by that of the triangles at the vertex.
    """
    count = len(parted.vertices)
    a, b, c = parted.faces.T
    p, q, r = (parted.vertices[x] * parted.unit for x in (a, b, c))
    areas = np.linalg.norm(np.cross(q - p, r - p), axis=1)
    own = np.bincount(parted.faces.reshape(-1), np.repeat(areas, 3), count)
    piece = connected(np.vstack((parted.faces[:, :2], parted.faces[:, 1:])), count)
    shares = np.bincount(piece[a], areas, count) / areas.sum()
    parts = np.round(shares[piece], DIGITS)
    old = np.bincount(index, own)
    with np.errstate(invalid="ignore", divide="ignore"):
        rounded = np.round(own / old[index], DIGITS)
    order = np.lexsort((np.arange(count), -rounded, -parts, index))
    return order[np.unique(index[order], return_index=True)[1]]


def on_edges(sides: Edges, edges: np.ndarray) -> np.ndarray:
    """Whether each side of faces lies on one of some edges (n, 2): (3 F,) bool."""
    count = int(max(sides.ends.max(initial=0), edges.max(initial=0))) + 1
    along = sides.ends @ np.array((count, 1))
    own = np.sort(edges, axis=1).astype(np.int64) @ np.array((count, 1))
    return np.append(np.isin(along, own), False)[sides.edge]  # -1, of no edge, is the last


def _fans(faces, edges):
    """(3 F,) a number for each corner, equal for those at one vertex that edges do not part."""
    sides = Edges(faces)
    first, second = sides.pairs().T
    inner = ~on_edges(sides, edges)[first]
    first, second = first[inner], second[inner]
    start = np.arange(faces.size)
    end = start - start % 3 + (start + 1) % 3
    opposed = sides.forward[first] != sides.forward[second]
    ends = (
        np.where(opposed, end[second], start[second]),
        np.where(opposed, start[second], end[second]),
    )
    pairs = np.column_stack((np.concatenate((start[first], end[first])), np.concatenate(ends)))
    return connected(pairs, faces.size)
