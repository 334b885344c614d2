"""Segments and triangles cut by a ball about the origin.

Here `at_a` and `at_b` are |a|^2 - r^2 and |b|^2 - r^2 of a ball of radius r, negative inside.
"""

import math
from collections import namedtuple

from .compiled import kernel
from .vectors import add, cross, divide, dot

# Arcs that end before they begin do so by rounding if they are shorter than this, in radians.
ROUNDING = 1e-7

Chord = namedtuple("Chord", "meets start end")
Chord.__doc__ = """Whether a segment from a to b meets the open ball, and its part in the ball,
a + t (b - a) for start <= t <= end in [0, 1]; both 0 where it does not."""

Arc = namedtuple("Arc", "angle start end")
Arc.__doc__ = """An arc of the sphere in the plane of a triangle: its angle about the triangle's
normal, 0 to 2 pi, and its ends; angle 0 where there is none."""

Cut = namedtuple("Cut", "twice normal height chords arcs area")
Cut.__doc__ = """The part of a triangle in a ball.

Attributes
----------
twice : float
    Twice the area of the whole triangle.
normal : tuple of 3 floats
    Unit; NaN for a triangle without area.
height : float
    Of the triangle's plane above the origin, along the normal.
chords : tuple of 3 Chords
    Of the edges from corner k to corner (k + 1) % 3.
arcs : tuple of 3 Arcs
    From the end of chord k to the start of the next; the first is a whole circle within the
    triangle.
area : float
    Of the part.
"""


@kernel
def chord(a, b, at_a, at_b, forward=True):
    """The Chord of a segment.

    Parameters
    ----------
    a, b : tuple of 3 floats
        Its ends.
    at_a, at_b : float
    forward : bool
        False has the same chord computed from b to a: so two triangles at an edge agree to the last
        bit on where it is cut.

    Returns
    -------
    Chord
    """
    if not forward:
        a, b, at_a, at_b = b, a, at_b, at_a
    d = add(b, -1.0, a)
    square, slope = dot(d, d), dot(a, d)
    power = slope * slope - square * at_a
    if not (at_a < 0 or at_b < 0 or (power > 0 and -square < slope < 0)):
        return Chord(False, 0.0, 0.0)
    root = math.sqrt(max(power, 0.0))
    start = 0.0 if at_a < 0 else min(max((-slope - root) / square, 0.0), 1.0)
    end = 1.0 if at_b < 0 else min(max((-slope + root) / square, 0.0), 1.0)
    return Chord(True, start, end) if forward else Chord(True, 1 - end, 1 - start)


@kernel
def segment_within(a, b, radius):
    """The part of a segment that lies in the ball about the origin.

    Parameters
    ----------
    a, b : tuple of 3 floats
        Its ends.
    radius : float
        Of the ball.

    Returns
    -------
    start, end : float
        The part is a + t (b - a), start <= t <= end, both in [0, 1]; (1, 0) where it is empty.
    """
    square = radius * radius
    meets, start, end = chord(a, b, dot(a, a) - square, dot(b, b) - square)
    return (start, end) if meets and start < end else (1.0, 0.0)


@kernel
def triangle_within(a, b, c, radius):
    """The part of a triangle's area that lies in the ball about the origin.

    Parameters
    ----------
    a, b, c : tuple of 3 floats
        Its corners.
    radius : float
        Of the ball.

    Returns
    -------
    float
        From 0 to 1; 0 for a triangle without area.
    """
    square = radius * radius
    at = dot(a, a) - square, dot(b, b) - square, dot(c, c) - square
    if max(at[0], at[1], at[2]) <= 0:
        facet = cross(add(b, -1.0, a), add(c, -1.0, a))
        return 1.0 if dot(facet, facet) > 0 else 0.0
    found = cut_triangle((a, b, c), at, (True, True, True), radius)
    return min(max(2 * found.area / found.twice, 0.0), 1.0) if found.twice > 0 else 0.0


@kernel
def cut_triangle(corners, at, forward, radius):
    """The Cut of a triangle: its plane cuts the ball in a disc about the origin's foot, and the
    part is bounded by straight chords and arcs of that disc's circle.

    Parameters
    ----------
    corners : tuple of 3 tuples of 3 floats
    at : tuple of 3 floats
        |x|^2 - r^2 at the corners.
    forward : tuple of 3 bools
        Of the edges, as in `chord`.
    radius : float
        Of the ball: r.

    Returns
    -------
    Cut
    """
    a, b, c = corners
    facet = cross(add(b, -1.0, a), add(c, -1.0, a))
    twice = math.sqrt(dot(facet, facet))
    normal = divide(facet, twice if twice > 0 else math.nan)
    height = dot(a, normal)
    disc = radius * radius - height * height
    chords = (
        chord(a, b, at[0], at[1], forward[0]),
        chord(b, c, at[1], at[2], forward[1]),
        chord(c, a, at[2], at[0], forward[2]),
    )
    area, whole = 0.0, disc > 0
    for k in range(3):
        beside = dot(cross(corners[k], corners[(k + 1) % 3]), normal)
        area += (chords[k].end - chords[k].start) * beside
        whole &= beside > 0 and not chords[k].meets
    plane = normal, height, disc, twice
    arcs = (
        _arc(0, corners, at, chords, plane),
        _arc(1, corners, at, chords, plane),
        _arc(2, corners, at, chords, plane),
    )
    if whole:
        d = add(b, -1.0, a)
        x = add((0.0, 0.0, 0.0), height, normal)
        x = add(x, math.sqrt(disc / dot(d, d)), d)
        arcs = Arc(2 * math.pi, x, x), arcs[1], arcs[2]
    area += disc * (arcs[0].angle + arcs[1].angle + arcs[2].angle)
    return Cut(twice, normal, height, chords, arcs, area / 2)


@kernel
def _arc(k, corners, at, chords, plane):
    """The Arc from the end of chord k to the next edge that enters the ball, or to this one."""
    normal, height, disc, twice = plane
    after = (k + 1) % 3
    if not chords[k].meets or at[after] < 0:
        return Arc(0.0, corners[k], corners[k])
    other = after
    while not (chords[other].meets and at[other] >= 0):
        other = (other + 1) % 3
    p, q = corners[k], corners[other]
    d = add(corners[after], -1.0, p)
    start = add(p, chords[k].end, d)
    end = add(q, chords[other].start, add(corners[(other + 1) % 3], -1.0, q))
    x, y = add(start, -height, normal), add(end, -height, normal)
    angle = math.atan2(dot(normal, cross(x, y)), dot(x, y))
    # Of more than half of the circle, which the triangle then is larger than. Its ends may be so
    # close on one edge that the angle between them has no sign.
    most = other == k and dot(cross(p, d), normal) > 0 and angle < 1
    if (angle < -ROUNDING or most) and twice > 3 * disc:
        angle += 2 * math.pi
    return Arc(angle, start, end)
