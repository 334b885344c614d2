"""What lies around a vertex or triangle: found in memory of the thread, then gathered.

A kind of neighbourhood is a pair of compiled functions: `find(reach, scratch, v)` returns how many
neighbours there are, -1 where the memory does not suffice, and `make(reach, scratch, v, count)` the
Disk or Ball.
"""

from collections import namedtuple

import numpy as np

from curvlib.kit.ball import gather_ball
from curvlib.kit.compiled import kernel
from curvlib.kit.disk import Walk, gather, space_for, star
from curvlib.kit.lanes import LANES
from curvlib.kit.parts import part

from .balls import triangles_within
from .geodesics import along_edges
from .neighbourhoods import CLOSED
from .searches import k_rings, within

# The most components of a field.
WIDEST = 32

Reach = namedtuple(
    "Reach", "vertices offsets neighbours stars normals areas unit rings radius geodesic at field"
)
Reach.__doc__ = """What is gathered from, and how far.

Attributes
----------
vertices : (V, 3)
    Of the mesh, or the centres of its triangles.
offsets, neighbours, stars
    Of an Adjacency.
normals : (V, 3) or (0, 3)
    Those that the mesh has, or those of the triangles.
areas : (V,) or (0,)
    Of the triangles, in the unit of a Disk.
unit : float
    Of the mesh.
rings : int
radius : float
    Instead of rings where it is finite.
geodesic : bool
    Whether the radius is measured along edges.
at : (m,) int32
    The vertices that have the neighbourhoods.
field : (V, c)
    That of the estimator; (V, 0) if it takes none.
"""

Scratch = namedtuple("Scratch", "stamps found hops space beside values path corners")
Scratch.__doc__ = """Memory of a thread; pages that a kind of neighbourhood does not use are not
touched.

Attributes
----------
stamps : (V,) int32
    As in `k_rings`.
found, hops : (length,) int32, (length + LANES,) uint8
    As in `k_rings`.
space
    As in `gather`.
beside : (WIDEST (length + LANES),)
    For the field at what was found.
values : (block, 10)
    Of the block.
path : tuple
    `marks`, `distances`, `keys`, `slots`, `who`, `lengths` and `edges` of `along_edges`.
corners : tuple
    `places`, `corners` and `beyond` of `triangles_within`; the number of triangles; `triangles` and
    `across` of a Ball.
"""


def scratch(reach, length, block):
    """A Scratch for up to `length` neighbours."""
    count, nodes = len(reach.vertices), len(reach.neighbours)
    path = (
        np.zeros(count, np.int64),
        np.empty(length + LANES),
        np.empty(8 * length),
        np.empty(8 * length, np.int32),
        np.empty(length, np.int32),
        np.empty(length),
        np.empty(length, np.uint8),
    )
    corners = (
        np.zeros(nodes, np.int64),
        np.empty(6 * length, np.int32),
        np.empty(6 * length, np.int32),
        np.empty(1, np.int64),
        np.empty(12 * length, np.int32),
    )
    return Scratch(
        np.zeros(count, np.int32),
        np.empty(length, np.int32),
        np.empty(length + LANES, np.uint8),
        space_for(length),
        np.empty(WIDEST * (length + LANES)),
        np.empty((block, 10)),
        path,
        corners,
    )


@kernel
def find_disk(reach, scratch, v):
    """Within rings, or a radius."""
    offsets, neighbours = reach.offsets, reach.neighbours
    stamps, found, hops = scratch.stamps, scratch.found, scratch.hops
    if reach.radius < np.inf:
        return within(offsets, neighbours, reach.vertices, v, reach.radius, stamps, found, hops)
    return k_rings(offsets, neighbours, v, reach.rings, stamps, found, hops)


@kernel
def find_geodesic(reach, scratch, v):
    """Within a radius along edges."""
    marks, distances, keys, slots, who, lengths, edges = scratch.path
    memory = marks, scratch.found, scratch.hops, distances, keys, slots, who, lengths, edges
    return along_edges(reach.offsets, reach.neighbours, reach.vertices, v, reach.radius, memory)


@kernel
def find_triangles(reach, scratch, v):
    """The corners of triangles within a radius."""
    places, corners, beyond, number, _ = scratch.corners
    memory = scratch.path[0], places, scratch.found, corners, beyond
    adjacency = reach.offsets, reach.neighbours, reach.stars
    count, number[0] = triangles_within(adjacency, reach.vertices, v, reach.radius, memory)
    return count


@kernel
def make_disk(reach, scratch, v, count):
    """The Disk of a vertex or of a triangle's centre."""
    distances = part(scratch.path[1], 0, (count + LANES if reach.geodesic else 0,))
    mesh = reach.vertices, reach.offsets, reach.neighbours, reach.unit, reach.field
    memory = scratch.stamps, scratch.found, scratch.hops, scratch.space, scratch.beside
    rings = reach.rings if reach.radius == np.inf else 0
    return gather(Walk(*mesh, *memory, v, rings), distances, count, _star(reach, v))


@kernel
def make_ball(reach, scratch, v, count):
    """The Ball of a vertex."""
    _, corners, beyond, number, indices = scratch.corners
    memory, found = (scratch.space, indices), scratch.found
    own, radius, unit = _star(reach, v), reach.radius, reach.unit
    n = number[0]
    return gather_ball(
        reach.vertices, v, found, count, corners, beyond, n, own, radius, unit, memory
    )


@kernel
def _star(reach, v):
    """The normal of a vertex, that which the mesh has, a third of its area, whether it is closed;
    those of a triangle."""
    exact = np.inf, np.inf, np.inf
    if len(reach.normals) > 0:
        exact = reach.normals[v, 0], reach.normals[v, 1], reach.normals[v, 2]
    if len(reach.areas) > 0:
        return exact, exact, reach.areas[v], True
    first, last, closed = reach.offsets[v], reach.offsets[v + 1], reach.stars[v] == CLOSED
    normal, area = star(reach.vertices, v, reach.neighbours, first, last, closed, reach.unit)
    return normal, exact, area, closed


# Kinds of neighbourhoods.
DISK = find_disk, make_disk
GEODESIC = find_geodesic, make_disk
BALL = find_triangles, make_ball
