"""The solid that the triangles of a ball bound: its volume and moments inside the ball, exactly.

The origin is the vertex v, u = |x|^2 - r^2 is negative inside the ball, m is the unit normal of a
face and h = x . m its distance from v. By the divergence theorem:

    3 int 1 dV     = sum_f int h dA + r^3 w               field x
    2 int x dV     = sum_f m int u dA                     fields u e_j
    5 int x^2 dV   = sum_f int h x^2 dA + r^5 w           field x^2 x
    4 int Y_ij dV  = sum_f int u (x_i m_j + x_j m_i - 2/3 h delta_ij) dA
                                                          fields u grad Y_ij, Y_ij = x_i x_j -
                                                          x^2 delta_ij / 3

where u vanishes on the sphere, so that w, the solid angle of the sphere's part in the solid, is all
that is needed of it. In a face's plane, a disc of radius s about the foot of v, u = y^2 - s^2
vanishes on the arcs as well: int u y dA = 1/4 sum int u^2 nu dl over straight edges alone.

The arcs determine w but for a multiple of 4 pi. An arc by an angle phi around m, seen from a pole p
of the sphere, spans the triangle (p, x, x') between its ends, (1 - h / r) phi about m, and not the
triangle (m, x, x'). Half the area of such a triangle is the argument of a complex number (Van
Oosterom, Strackee 1983), so that a product of complex numbers sums up all of them. The volume lies
between 0 and that of the ball, which settles the multiple.
"""

import math
from collections import namedtuple

import numpy as np

from .compiled import kernel
from .cut import ROUNDING, cut_triangle
from .vectors import add, at, cross, divide, dot, norm

Solid = namedtuple("Solid", "volume first second")
Solid.__doc__ = """Moments of the part of a solid in a ball, about the vertex.

Attributes
----------
volume : float
first : tuple of 3 floats
    int x dV
second : tuple of 6 floats
    int x x^T dV: xx, xy, xz, yy, yz, zz.
"""

_Sums = namedtuple("_Sums", "volume first second angle re im")
_Sums.__doc__ = """Sums over faces: 2 int h dA, int m u dA, the symmetric part of int u x m^T dA as
in a Solid; over arcs: (1 - h / r) phi, and the product of complex numbers."""


@kernel
def solid(ball):
    """The moments of the solid behind the triangles of a ball.

    Parameters
    ----------
    ball : Ball

    Returns
    -------
    Solid
        NaN where the triangles do not bound a solid inside the ball: an edge of the mesh's boundary
        lies there, or the normals of the triangles at the vertex cancel; and where the whole
        surface lies there, since then the ball says nothing about one of its points.
    """
    points, triangles, across, r = ball.points, ball.triangles, ball.across, ball.radius
    none = (0.0, 0.0, 0.0)
    sums = _Sums(0.0, none, (*none, *none), 0.0, 1.0, 0.0)
    open_edges, cut = 0, 0
    for k in range(triangles.shape[1]):
        i, j, l = triangles[0, k], triangles[1, k], triangles[2, k]  # noqa: E741
        a, b, c = at(points, i), at(points, j), at(points, l)
        u = dot(a, a) - r * r, dot(b, b) - r * r, dot(c, c) - r * r
        if u[0] < 0 and u[1] < 0 and u[2] < 0:
            sums = _whole(sums, a, b, c, u, r)
            for n in range(3):
                open_edges += across[n, k] < 0
        else:
            found = cut_triangle((a, b, c), u, (i < j, j < l, l < i), r)
            for n in range(3):
                if across[n, k] < 0:
                    p, q = (a, b, c)[n], (b, c, a)[n]
                    length = (found.chords[n].end - found.chords[n].start) * norm(add(q, -1.0, p))
                    open_edges += length > ROUNDING * r
            sums = _part(sums, (a, b, c), u, found, ball.normal, r)
            cut += 1
    return _moments(sums, r if open_edges == 0 and cut > 0 else math.nan)


@kernel
def _moments(sums, r):
    """The Solid in a ball of radius r."""
    cube = r * r * r
    volume = sums.volume / 2 - cube * (sums.angle + 2 * math.atan2(sums.im, sums.re))
    ball = 4 * math.pi * cube
    volume -= ball * np.floor(volume / ball)
    xx, xy, xz, yy, yz, zz = sums.second
    if math.isnan(volume):
        nan = (math.nan, math.nan, math.nan)
        return Solid(math.nan, nan, (*nan, *nan))
    trace = xx + yy + zz  # int h u dA as well
    third = (trace + r * r * volume) / 15 - trace / 6
    second = xx / 2 + third, xy / 2, xz / 2, yy / 2 + third, yz / 2, zz / 2 + third
    return Solid(volume / 3, divide(sums.first, 2.0), second)


@kernel
def _whole(sums, a, b, c, u, r):
    """Add a triangle inside the ball: means of polynomials over it, in its corners."""
    f = cross(add(b, -1.0, a), add(c, -1.0, a))
    s = add(add(a, 1.0, b), 1.0, c)
    square, total = dot(s, s), u[0] + u[1] + u[2] + 3 * r * r
    mean = (total + square) / 12 - r * r
    # 60 times the mean of x^2 x is (s^2 + sum p^2) s + 2 sum (p . s + p^2) p over corners p.
    g = add((0.0, 0.0, 0.0), (square + total) / 60 - r * r / 3, s)
    g = add(g, (dot(a, s) + u[0] + r * r) / 30, a)
    g = add(g, (dot(b, s) + u[1] + r * r) / 30, b)
    g = add(g, (dot(c, s) + u[2] + r * r) / 30, c)
    return _Sums(
        sums.volume + dot(a, f),
        add(sums.first, mean / 2, f),
        _symmetric(sums.second, 0.5, g, f),
        sums.angle,
        sums.re,
        sums.im,
    )


@kernel
def _symmetric(sums, x, a, b):
    """sums + x (a b^T + b a^T) / 2."""
    half = x / 2
    return (
        sums[0] + x * (a[0] * b[0]),
        sums[1] + half * (a[0] * b[1] + a[1] * b[0]),
        sums[2] + half * (a[0] * b[2] + a[2] * b[0]),
        sums[3] + x * (a[1] * b[1]),
        sums[4] + half * (a[1] * b[2] + a[2] * b[1]),
        sums[5] + x * (a[2] * b[2]),
    )


@kernel
def _part(sums, corners, u, found, pole, r):
    """Add a triangle that the sphere cuts: integrals along its edges, and arcs between them."""
    twice, m, h, chords, arcs, area = found
    if twice == 0:
        return sums
    power, along = 0.0, (0.0, 0.0, 0.0)
    for n in range(3):
        after = (n + 1) % 3
        p, d = corners[n], add(corners[after], -1.0, corners[n])
        d = add((0.0, 0.0, 0.0), chords[n].end - chords[n].start, d)
        out = cross(d, m)
        start, end = min(u[n], 0.0), min(u[after], 0.0)
        both, square = start + end, dot(d, d)
        power += dot(p, out) * (both / 2 - square / 6)
        fourth = (start * start + start * end + end * end) / 3 + square * (square / 30 - both / 6)
        along = add(along, fourth / 4, out)
    power = power / 4 - (r * r - h * h) * area / 2
    angle, re, im = sums.angle, sums.re, sums.im
    for n in range(3):
        if arcs[n].angle != 0:
            re, im = _triangles(arcs[n], m, h, pole, r, re, im)
            angle += (1 - h / r) * arcs[n].angle
    return _Sums(
        sums.volume + 2 * h * area,
        add(sums.first, power, m),
        _symmetric(sums.second, 1.0, add(along, h * power, m), m),
        angle,
        re,
        im,
    )


@kernel
def _triangles(arc, m, h, pole, r, re, im):
    """The product of complex numbers with those of the triangles of an arc."""
    turn, x, y = arc
    x0, y0 = add(x, -h, m), add(y, -h, m)
    # Triangles are small: one between opposite points would be none.
    pieces = 1 + int(abs(turn))
    quarter, centre, z, z0 = cross(m, x0), add((0.0, 0.0, 0.0), h, m), x, x0
    for n in range(1, pieces + 1):
        w, w0, z, z0 = z, z0, y, y0
        if n < pieces:
            step = n * turn / pieces
            z0 = add(add((0.0, 0.0, 0.0), math.cos(step), x0), math.sin(step), quarter)
            z = add(centre, 1.0, z0)
        a, b = r * (r + dot(pole, w) + dot(pole, z)) + dot(w, z), dot(pole, cross(w, z))
        c, d = (r + h) ** 2 + dot(w0, z0), dot(m, cross(w0, z0))
        # (a + b i) (c - d i)
        a, b = a * c + b * d, b * c - a * d
        re, im = re * a - im * b, re * b + im * a
        size = abs(re) + abs(im)
        re, im = re / size, im / size
    return re, im
