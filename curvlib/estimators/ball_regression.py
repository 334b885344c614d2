"""Averaged normals, regressed on position over a ball."""

from typing import Annotated

import numpy as np

from curvlib.kit.compiled import kernel
from curvlib.kit.fit import CUTOFF
from curvlib.kit.options import Length
from curvlib.kit.tensor import from_form
from curvlib.kit.vectors import add, at, cross, divide, dot, norm, tangents

LABEL = "Ball regression"
SOURCE = "https://doi.org/10.1371/journal.pcbi.1007962"
STYLE = {"color": "#AA4499", "marker": "o", "linestyle": "-"}

# Normals are averaged over this part of the radius.
INNER = 0.4


@kernel
def areas(ball):
    """A third of the vector area of the triangles of `ball`, the sum of their facets: a staircase
    has that of the slope through its steps."""
    total = (0.0, 0.0, 0.0)
    for t in range(ball.triangles.shape[1]):
        a = at(ball.points, ball.triangles[0, t])
        b = add(at(ball.points, ball.triangles[1, t]), -1.0, a)
        total = add(total, 1 / 6, cross(b, add(at(ball.points, ball.triangles[2, t]), -1.0, a)))
    return total


@kernel
def averaged(disk, areas, radius: Annotated[Length, INNER] = "5 edges"):
    """The unit vector u along the mean of the vector `areas` A of a `disk` within `radius`, INNER
    that of the ball, weighted by 1 - (d / radius)^2 at the distance d; and A . u of the vertex."""
    own, inner = at(areas, 0), 1 / radius
    total = own
    for i in range(disk.count):
        x, y, z = disk.e[0, i] * inner, disk.e[1, i] * inner, disk.e[2, i] * inner
        weight = 1 - (x * x + y * y + z * z)
        if weight > 0 and areas[0, 1 + i] == areas[0, 1 + i]:
            total = add(total, weight, at(areas, 1 + i))
    u = divide(total, norm(total))
    return u[0], u[1], u[2], dot(own, u)


@kernel
def estimate(disk, averaged, radius: Length = "5 edges"):
    """All of K, H, k1, k2, d1 and d2 of the symmetric part of S in u_T = c + S x, fitted by least
    squares to averaged normals u of the vertices within a radius; u_T and x are in the plane across
    the u of the vertex.

    Parameters
    ----------
    disk : Disk
        The vertices within the radius of a vertex.
    averaged : (4, 1 + n)
        Of the vertex and its neighbours u, the mean of the vector areas A within 0.4 radii, brought
        to unit length, and A . u.
    radius : length
        Of the ball.

    Returns
    -------
    Curvatures
        Pointwise, in 1/length^2 and 1/length, positive where the surface bends away from its
        normal; d1 and d2 are NaN at an umbilic. NaN: needs a disk or half-disk of triangles, and
        three vertices within the radius, not in one line, whose averaged normals exist. Vertices on
        a boundary have values.

    Notes
    -----
    Weights are (A . u) (1 - d^2 / radius^2), d being the distance from the vertex; vertices whose
    A . u is negative, as on a fold, are left out. Noise of the vertices enters through normals that
    are means over a sixth of the ball's area, and not through heights, which a staircase displaces
    by half a step.

    Order: O(r^2) for a radius r in the length of the mesh that does not depend on h, and O(h) for
    r ~ sqrt(h), measured on irregular meshes. For r in edges none: averaged normals there are O(h)
    off. At 5 edges errors of K and H fall as h^1.8 from 2,500 to 40,000 vertices, and ever slower
    then; at 3 edges they stand still from 40,000 on.

    Source: normals voted by neighbours, after Salfer et al. (2020), Reliable estimation of membrane
    curvature for cryo-electron tomography, and Page et al. (2002); the regression of normals on
    position, Rusinkiewicz (2004).
    """
    N = at(averaged, 0)
    X, Y = tangents(N)
    inverse = 1 / radius
    # The vertex itself, at the origin with u_T = 0, adds to the weight alone.
    total = max(averaged[3, 0], 0.0)
    x1 = y1 = p1 = q1 = xx = xy = yy = xp = yp = xq = yq = 0.0
    for i in range(disk.count):
        e = disk.e[0, i] * inverse, disk.e[1, i] * inverse, disk.e[2, i] * inverse
        u = at(averaged, 1 + i)
        weight = averaged[3, 1 + i] * (1 - dot(e, e))
        if weight > 0:
            x, y, p, q = dot(e, X), dot(e, Y), dot(u, X), dot(u, Y)
            total += weight
            x1, y1, p1, q1 = x1 + weight * x, y1 + weight * y, p1 + weight * p, q1 + weight * q
            xx, xy, yy = xx + weight * x * x, xy + weight * x * y, yy + weight * y * y
            xp, yp = xp + weight * x * p, yp + weight * y * p
            xq, yq = xq + weight * x * q, yq + weight * y * q
    over = 1 / total
    xx, xy, yy = xx - x1 * x1 * over, xy - x1 * y1 * over, yy - y1 * y1 * over
    xp, yp, xq, yq = (
        xp - x1 * p1 * over,
        yp - y1 * p1 * over,
        xq - x1 * q1 * over,
        yq - y1 * q1 * over,
    )
    determinant = xx * yy - xy * xy
    if not determinant > (CUTOFF * (xx + yy)) ** 2:
        determinant = np.nan
    scale = inverse / determinant
    a, c = (yy * xp - xy * yp) * scale, (xx * yq - xy * xq) * scale
    b = (xx * yp - xy * xp + yy * xq - xy * yq) / 2 * scale
    return from_form(a, b, c, X, N)
