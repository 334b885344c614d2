"""Disks: a vertex and those within some edges or some length of it, on open meshes too.

An estimator is given one disk at a time. Arrays run over the neighbours, contiguous in memory and
padded to a multiple of LANES (curvlib.kit.lanes): loops over them are vectorised.
"""

from collections import namedtuple

import numpy as np

from curvlib.errors import InputError

from .compiled import kernel
from .lanes import LANES
from .parts import part
from .ring import SHEET
from .vectors import add, cross, divide, dot

ROWS, SPACE = 64, 4096
# A ring that brings a disk to more neighbours than this is left out, and those behind it: the
# neighbours of a vertex of valence n would have disks of n vertices each, n^2 in all.
MOST = 1024

Disk = namedtuple(
    "Disk",
    "e weights hops distances normal exact_normal area closed radius count rows space walk",
)
Disk.__doc__ = """The neighbours of a vertex v.

Attributes
----------
e : (3, n)
    Vectors v_i - v; the padding is zero. Neighbours come ring by ring; the first ring
    counter-clockwise seen from outside, at the boundary from one end to the other.
weights : (n,)
    1 for a neighbour, 0 for padding.
hops : (n,) uint8
    Distance from v in edges, at most 255; 0 for padding.
distances : (n,) or (0,)
    Where a radius is `Geodesic`, the length of the shortest path along edges; 0 for padding.
    Neighbours then come from the nearest on, and `hops` is the number of edges of that path.
normal : tuple of 3 floats
    Unit mean of the normals of the triangles at v, weighted by area; NaN where they cancel, as
    `star_normal` says.
exact_normal : tuple of 3 floats
    The unit normal that the mesh has at the vertex; infinite for a mesh without normals.
area : float
    A third of the area of the triangles at v.
closed : bool
    Whether the triangles at v close to one ring; else v lies on the boundary.
radius : float
    The largest |v_i - v|.
count : int
    Number of neighbours; n is the next multiple of LANES.
rows : (ROWS, n)
    For arrays of the estimator: the first three are e, the fourth are the weights, and the others
    hold what the last vertex left there.
space : (SPACE,)
    For others, likewise.
walk : Walk
    For `wider`.
"""

Walk = namedtuple(
    "Walk", "vertices offsets neighbours unit field stamps found hops space values v rings"
)
Walk.__doc__ = """How the disk of the vertex v was found: arguments of the search and of `gather`.

`rings` is their number, 0 for a disk within some length; `values` is memory for the field.
"""


def space_for(count):
    """The `space` that `gather` needs for up to `count` neighbours.

    It begins at a multiple of 64 bytes, and so do all rows: others would take twice the time, each
    vector lying in two cache lines.
    """
    room = np.empty(ROWS * (count + LANES) + SPACE + LANES)
    start = -room.ctypes.data // room.itemsize % LANES
    return room[start : len(room) - LANES + start]


@kernel
def gather(walk, distances, count, star):
    """Gather the Disk of a vertex.

    Parameters
    ----------
    walk : Walk
        `vertices` (V, 3) in the unit of the mesh, the vertex `v`; `found` (count or more,) int32,
        its neighbours; `hops` (count + LANES - 1 or more,) uint8, their distances in edges, on
        return padded; `unit`, `Mesh.unit`, by which lengths of the Disk are multiplied; `space`
        (ROWS n + SPACE or more,), memory for `Disk.rows` and `Disk.space`.
    distances : (count + LANES - 1 or more,) or (0,)
        Those along edges, in the unit of the mesh; on return in that of the Disk, and padded.
    count : int
        Of neighbours.
    star : tuple
        `normal`, `exact_normal`, `area` and `closed` of the Disk.

    Returns
    -------
    Disk
    """
    vertices, v, found, hops, unit = walk.vertices, walk.v, walk.found, walk.hops, walk.unit
    n, space = (count + LANES - 1) // LANES * LANES, walk.space
    e, weights = part(space, 0, (3, n)), part(space, 3 * n, (n,))
    x, y, z = vertices[v, 0], vertices[v, 1], vertices[v, 2]
    for i in range(count):
        u = np.uint64(found[i])
        e[0, i] = (vertices[u, 0] - x) * unit
        e[1, i] = (vertices[u, 1] - y) * unit
        e[2, i] = (vertices[u, 2] - z) * unit
    for i in range(count):
        weights[i] = 1.0
    rows, rest = part(space, 0, (ROWS, n)), part(space, ROWS * n, (SPACE,))
    for i in range(count, n):
        e[0, i], e[1, i], e[2, i], weights[i], hops[i] = 0.0, 0.0, 0.0, 0.0, 0
    farthest = 0.0
    for i in range(count):
        square = e[0, i] * e[0, i] + e[1, i] * e[1, i] + e[2, i] * e[2, i]
        farthest = square if square > farthest else farthest
    for i in range(min(n, len(distances))):
        distances[i] = distances[i] * unit if i < count else 0.0
    lengths = part(distances, 0, (min(n, len(distances)),))
    radius = np.sqrt(farthest)
    return Disk(e, weights, part(hops, 0, (n,)), lengths, *star, radius, count, rows, rest, walk)


@kernel
def gather_field(field, v, found, count, values):
    """Gather a field at a vertex and its neighbours.

    Parameters
    ----------
    field : (V, c)
    v : int
        The vertex.
    found : (count or more,) int32
        The neighbours.
    count : int
    values : (c, 1 + n)
        Set: first at the vertex, zero behind the neighbours.
    """
    components, width = values.shape
    for c in range(components):
        values[c, 0] = field[v, c]
        for i in range(1 + count, width):
            values[c, i] = 0.0
    for i in range(count):
        u = np.uint64(found[i])
        for c in range(components):
            values[c, 1 + i] = field[u, c]


@kernel
def normals(disk):
    """The normal of the vertex's triangles, weighted by area: a field for estimators.

    Parameters
    ----------
    disk : Disk

    Returns
    -------
    tuple of 3 floats
    """
    return disk.normal


@kernel
def given_normal(disk):
    """The unit normal that the mesh has at the vertex.

    Parameters
    ----------
    disk : Disk

    Returns
    -------
    tuple of 3 floats
        NaN where the surface has none.

    Raises
    ------
    InputError
        The mesh has no normals.
    """
    if disk.exact_normal[0] == np.inf:
        raise InputError("normals='given' needs a mesh with normals; this one has none")
    return disk.exact_normal


@kernel
def star(vertices, v, neighbours, first, last, closed, unit):
    """The mean normal and the area of the triangles at a vertex.

    Parameters
    ----------
    vertices : (V, 3)
    v : int
        The vertex.
    neighbours : (last or more,) int32
        From `first` on to `last`, a walk around it.
    first, last : int
    closed : bool
        Whether there is a triangle between the last neighbour and the first.
    unit : float
        As in `gather`.

    Returns
    -------
    normal : tuple of 3 floats
        The mean of their normals, weighted by area, unit; NaN where the normals cancel: the square
        of their sum is at most SHEET^2 times their number times the sum of their squares, which is
        not less than that of their lengths squared.
    area : float
        A third of the area of the triangles.
    """
    x, y, z = vertices[v, 0], vertices[v, 1], vertices[v, 2]
    total, squares, before, start = (0.0, 0.0, 0.0), 0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    area = 0.0
    for i in range(first, last):
        u = np.uint64(neighbours[i])
        e = (vertices[u, 0] - x) * unit, (vertices[u, 1] - y) * unit, (vertices[u, 2] - z) * unit
        if i == first:
            start = e
        else:
            facet = cross(before, e)
            total, squares = add(total, 1.0, facet), squares + dot(facet, facet)
            area += np.sqrt(dot(facet, facet))
        before = e
    if closed:
        facet = cross(before, start)
        total, squares = add(total, 1.0, facet), squares + dot(facet, facet)
        area += np.sqrt(dot(facet, facet))
    square = dot(total, total)
    proper = square > SHEET**2 * (last - first) * squares
    return divide(total, np.sqrt(square) if proper else np.nan), area / 6
