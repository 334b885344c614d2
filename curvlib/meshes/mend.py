"""Meshes with their points joined, or their triangles turned outward."""

import numpy as np

from curvlib.errors import InputError

from .mesh import Mesh
from .neighbourhoods import BROKEN, CLOSED
from .sound import repeated


def weld(mesh: Mesh, distance: float = 0.0) -> tuple[Mesh, np.ndarray]:
    """Join vertices that stand at one place, as readers leave them that split corners.

    Only vertices whose triangles do not close to a ring are joined, and only to others of which
    that is true: closed sheets that touch stay apart. Where the triangles would form neither a disk
    nor a half-disk together, but do so apart, corners are joined of triangles that agree over an
    edge of two. Of triangles that are there more than once, whichever side they face, all but the
    first are left out: they name one vertex three times.

    Parameters
    ----------
    mesh : Mesh
    distance : float
        Vertices that a chain of steps of at most this length connects, in the unit of the mesh,
        are joined; 0 for those with equal coordinates.

    Returns
    -------
    welded : Mesh
        With the same vertices in the same order, of which those that were joined to another have
        no triangle; its normals, if the mesh has some, are the means of those joined. Exact values
        are not kept.
    index : ndarray of int, (V,)
        The vertex to which each was joined, or itself.

    Raises
    ------
    InputError
        The distance is negative or not finite.

    Examples
    --------
    >>> import numpy as np
    >>> from curvlib import Mesh
    >>> corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    >>> welded, index = weld(Mesh(corners, [[0, 1, 2], [3, 4, 5]]))
    >>> index
    array([0, 1, 2, 1, 4, 2])
    """
    if not 0 <= distance < np.inf:
        raise InputError(f"distance: {distance!r} is not a length of at least 0")
    mesh, first, _ = once(mesh, mesh.find_adjacency().stars != CLOSED)
    stars = mesh.find_adjacency().stars
    used = np.zeros(len(mesh.vertices), dtype=bool)
    used[mesh.faces] = True
    loose = np.flatnonzero((stars != CLOSED) & used)
    groups = _groups(mesh.vertices[loose], distance)
    index, welded = _joined(mesh, loose, groups)
    new = welded.find_adjacency().stars[index[loose]]
    several = np.bincount(index, minlength=len(index))[index[loose]] > 1
    spoiled = several & (new == BROKEN) & (stars[loose] != BROKEN)
    if not spoiled.any():
        return welded, index[first]
    # Elsewhere nothing changes, lest one fault leave its neighbours with two slits, theirs too.
    spoiled = np.isin(groups, groups[spoiled])
    fans = _fans(mesh, welded, index, np.isin(np.arange(len(index)), loose[spoiled]))
    groups[spoiled] = groups.max() + 1 + fans[loose[spoiled]]
    index, welded = _joined(mesh, loose, groups)
    return welded, index[first]


def once(mesh, loose):
    """A mesh without the triangles that are there again, the index of `repeated`, and how many they
    are. `loose` (V,) bool: where triangles do not close to one ring."""
    again, index = repeated(mesh.vertices, mesh.faces, loose)
    count = np.count_nonzero(again)
    if count:
        faces = index[mesh.faces]
        faces[again] = faces[again, :1]
        mesh = _remade(mesh, faces, mesh.normals)
        mesh.left_out = again if mesh.left_out is None else again | mesh.left_out
    return mesh, index, count


def _remade(mesh, faces, normals):
    """The mesh with other faces, of which the same are left out."""
    made = Mesh(mesh.vertices, faces, copy=False, normals=normals)
    made.concerned, made.left_out = mesh.concerned, mesh.left_out
    return made


def _joined(mesh, loose, groups):
    """The index, each of the vertices `loose` joined to the first of its group, and the mesh."""
    index = np.arange(len(mesh.vertices))
    _, first, inverse = np.unique(groups, return_index=True, return_inverse=True)
    index[loose] = loose[first[inverse.reshape(-1)]]
    normals = _means(mesh, index)
    return index, _remade(mesh, index[mesh.faces], normals)


def _fans(mesh, welded, index, among):
    """(V,) numbers, equal for those of the vertices `among` (V,) bool that are to be joined: of
    triangles on either side of an edge of two in the welded mesh, if they agree."""
    edges = Edges(welded.faces)
    first, second = edges.pairs().T
    agree = edges.forward[first] != edges.forward[second]
    first, second = first[agree], second[agree]
    start, end = mesh.faces.reshape(-1), np.roll(mesh.faces, -1, axis=1).reshape(-1)
    one = np.concatenate((start[first], end[first]))
    other = np.concatenate((end[second], start[second]))
    pairs = np.column_stack((one, other))[among[one] & among[other]]
    return connected(pairs, len(index))


def _groups(points, distance):
    """A number for each point, equal where points are to be joined."""
    if distance == 0:
        _, groups = np.unique(points, axis=0, return_inverse=True)
        return groups.reshape(-1)
    from scipy.spatial import cKDTree

    pairs = cKDTree(points).query_pairs(distance, output_type="ndarray")
    return connected(pairs, len(points))


def connected(pairs, count):
    """(count,) the number of each one's component."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    a, b = pairs.T
    graph = coo_matrix((np.ones(len(a), bool), (a, b)), (count, count))
    return connected_components(graph, directed=False)[1]


def _means(mesh, index):
    """The normals of a mesh, summed where vertices are joined; None where it has none."""
    if mesh.normals is None:
        return None
    sums = np.zeros_like(mesh.normals)
    np.add.at(sums, index, mesh.normals)
    return sums


def orient(mesh: Mesh) -> tuple[Mesh, np.ndarray]:
    """Turn triangles over so that neighbours agree and closed components face outward.

    Parameters
    ----------
    mesh : Mesh

    Returns
    -------
    oriented : Mesh
        With the same vertices and normals. Triangles on either side of an edge of two agree; a
        closed component has a positive volume; of an open one the triangles that are fewer, by
        area, are turned to the others. A component that cannot be oriented, such as a Moebius
        strip, stays as it is.
    turned : ndarray of bool, (F,)
        Which triangles were turned over.

    Examples
    --------
    >>> from curvlib import Mesh
    >>> square = Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 3, 2]])
    >>> orient(square)[1].sum()
    np.int64(1)
    """
    edges = Edges(mesh.faces)
    component, parity, orientable = _parities(edges, len(mesh.faces))
    count = component.max(initial=-1) + 1
    corners = mesh.vertices[mesh.faces] * mesh.unit
    facets = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.sqrt((facets * facets).sum(1))
    signs = 1 - 2 * parity
    # Volumes about a point of the component, lest a far origin leave rounding alone.
    start = np.zeros(count, dtype=np.intp)
    start[component[::-1]] = np.arange(len(mesh.faces))[::-1]
    volume = (signs * ((corners[:, 0] - corners[start[component], 0]) * facets).sum(1)) / 6
    volume = np.bincount(component, volume, count)
    majority = np.bincount(component, signs * area, count)
    open_ = np.bincount(component[edges.face[edges.uses == 1]], minlength=count) > 0
    flip = np.where(open_, majority, volume) < 0
    turned = ((parity == 1) != flip[component]) & orientable[component]
    faces = np.where(turned[:, None], mesh.faces[:, ::-1], mesh.faces)
    return _remade(mesh, faces, mesh.normals), turned


class Edges:
    """The sides of faces, 3 F of them, and which stand on one edge.

    Attributes
    ----------
    face : (3 F,)
        The face of each side.
    edge : (3 F,)
        A number of its edge; -1 for sides of a face that names a vertex twice.
    forward : (3 F,) bool
        Whether the side runs from the smaller vertex to the larger one.
    uses : (3 F,)
        How many sides its edge has; 0 where that is -1.
    ends : (E, 2)
        The two vertices of each edge, the smaller one first.
    """

    def __init__(self, faces):
        a, b, c = faces.T
        proper = np.repeat((a != b) & (b != c) & (c != a), 3)
        start, end = faces.reshape(-1), np.roll(faces, -1, axis=1).reshape(-1)
        self.face = np.repeat(np.arange(len(faces)), 3)
        self.forward = start < end
        pairs = np.column_stack((np.minimum(start, end), np.maximum(start, end)))
        most = int(faces.max(initial=0)) + 1
        keys = pairs[:, 0].astype(np.int64) * most + pairs[:, 1]
        own, inverse, uses = np.unique(keys[proper], return_inverse=True, return_counts=True)
        self.edge = np.full(len(keys), -1)
        self.edge[proper] = inverse.reshape(-1)
        self.uses = np.zeros(len(keys), dtype=np.intp)
        self.uses[proper] = uses[inverse.reshape(-1)]
        self.ends = np.column_stack((own // most, own % most))

    def pairs(self):
        """The two sides of each edge that has two: (n, 2) indices of sides."""
        of_two = np.flatnonzero(self.uses == 2)
        order = of_two[np.argsort(self.edge[of_two], kind="stable")]
        return order.reshape(-1, 2)


def _parities(edges, count):
    """Of each face its component by edges of two faces and whether it is to be turned over for its
    component to agree, 0 or 1; of each component whether it can agree."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    first, second = edges.pairs().T
    f, g = edges.face[first], edges.face[second]
    # A node for each side of each face; sides of neighbours that face the same way are joined.
    # Sides of an edge that run the same way belong to faces that disagree.
    g_front = g + count * (edges.forward[first] == edges.forward[second])
    g_back = g + count * (edges.forward[first] != edges.forward[second])
    rows, columns = np.concatenate((f, f + count)), np.concatenate((g_front, g_back))
    graph = coo_matrix((np.ones(len(rows), bool), (rows, columns)), (2 * count, 2 * count))
    _, side = connected_components(graph, directed=False)
    front, back = side[:count], side[count:]
    # Of an orientable component the fronts and backs are two components of sides, else one.
    _, roots, component = np.unique(np.minimum(front, back), return_index=True, return_inverse=True)
    component = component.reshape(-1)
    parity = (front != front[roots][component]).astype(np.int8)
    return component, parity, front[roots] != back[roots]
