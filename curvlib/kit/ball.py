"""Balls: the triangles of a mesh within some length of a vertex, cut where they leave it.

The triangles are those that are connected to the vertex through edges which meet the open ball: the
component of the mesh within the ball that the vertex lies on. An estimator is given one ball at a
time.
"""

from collections import namedtuple

import numpy as np

from .compiled import kernel
from .cut import triangle_within
from .disk import SPACE
from .parts import part

Ball = namedtuple(
    "Ball", "points triangles across inside normal exact_normal area closed radius space"
)
Ball.__doc__ = """The triangles around a vertex v.

Attributes
----------
points : (3, p)
    Vectors from v: of v itself, of which index is 0, and of the other corners of the triangles,
    outside the ball too.
triangles : (3, m) int32
    Corners as indices of points, counter-clockwise seen from outside. Those at v come first, in
    their order around it, v being corner 0.
across : (3, m) int32
    The triangle behind the edge from corner k to corner (k + 1) % 3; -1 where there is none, or
    where the edge does not meet the open ball.
inside : (m,)
    The part of the triangle's area that lies in the ball, from 0 to 1.
normal : tuple of 3 floats
    As that of a Disk.
exact_normal : tuple of 3 floats
    As that of a Disk.
area : float
    As that of a Disk.
closed : bool
    Whether the triangles at v close to one ring; else v lies on the boundary.
radius : float
    Of the ball. Infinite where none was chosen: then there are the triangles at v alone.
space : (SPACE,)
    Memory for the estimator, which holds what the last vertex left there.
"""


@kernel
def gather_ball(vertices, v, found, count, corners, beyond, number, star, radius, unit, memory):
    """Gather the Ball of a vertex.

    Parameters
    ----------
    vertices : (V, 3)
        Coordinates, in the unit of the mesh.
    v : int
        The vertex.
    found : (count or more,) int32
        The other corners of its triangles.
    count : int
        Their number.
    corners, beyond : (3 number or more,) int32
        The `triangles` and `across` of the Ball, triangle by triangle.
    number : int
        Of triangles.
    star : tuple
        `normal`, `exact_normal`, `area` and `closed` of the Ball.
    radius : float
        In the unit of the mesh.
    unit : float
        `Mesh.unit`: lengths of the Ball are multiplied by it.
    memory : tuple
        Float64 memory for `points`, `inside` and `space`, 3 (count + 1) + number + SPACE numbers
        or more; and int32 memory, 6 number.

    Returns
    -------
    Ball
    """
    space, indices = memory
    size, radius = count + 1, radius * unit
    points, inside = part(space, 0, (3, size)), part(space, 3 * size, (number,))
    triangles = part(indices, 0, (3, number))
    across = part(indices, 3 * number, (3, number))
    for c in range(3):
        points[c, 0] = 0.0
    for i in range(count):
        u = np.uint64(found[i])
        for c in range(3):
            points[c, i + 1] = (vertices[u, c] - vertices[v, c]) * unit
    for k in range(3):
        for t in range(number):
            triangles[k, t] = corners[3 * t + k]
            across[k, t] = beyond[3 * t + k]
    for t in range(number):
        inside[t] = 1.0
        if radius < np.inf:
            i, j, k = triangles[0, t], triangles[1, t], triangles[2, t]
            a = points[0, i], points[1, i], points[2, i]
            b = points[0, j], points[1, j], points[2, j]
            c = points[0, k], points[1, k], points[2, k]
            inside[t] = triangle_within(a, b, c, radius)
    rest = part(space, 3 * size + number, (SPACE,))
    return Ball(points, triangles, across, inside, *star, radius, rest)
