"""Segments and triangles cut by a ball about the origin."""

import math

import numpy as np

from .compiled import kernel
from .vectors import add, cross, dot


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
    d = add(b, -1.0, a)
    along, square = dot(a, d), dot(d, d)
    gap = along * along - square * (dot(a, a) - radius * radius)
    if not gap > 0:
        return 1.0, 0.0
    root = np.sqrt(gap)
    start, end = max((-along - root) / square, 0.0), min((root - along) / square, 1.0)
    return (start, end) if start < end else (1.0, 0.0)


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
        From 0 to 1: the triangle's plane cuts the ball in a disc, whose area in the triangle is
        summed over the triangle's edges, as triangles within the disc and sectors outside it.
        0 for a triangle without area.
    """
    normal = cross(add(b, -1.0, a), add(c, -1.0, a))
    square = dot(normal, normal)
    if not square > 0:
        return 0.0
    if max(dot(a, a), dot(b, b), dot(c, c)) <= radius * radius:
        return 1.0
    twice = np.sqrt(square)
    height = dot(a, normal) / twice
    disc = radius * radius - height * height
    if not disc > 0:
        return 0.0
    within = _beside(a, b, normal, height, disc, radius)
    within += _beside(b, c, normal, height, disc, radius)
    within += _beside(c, a, normal, height, disc, radius)
    return min(max(within / twice, 0.0), 1.0)


@kernel
def _beside(a, b, normal, height, disc, radius):
    """Twice the signed area of the disc between the lines from its centre to a and to b, on the
    centre's side of the segment a b."""
    start, end = segment_within(a, b, radius)
    scale = 1 / np.sqrt(dot(normal, normal))
    foot = normal[0] * scale * height, normal[1] * scale * height, normal[2] * scale * height
    p, q = add(a, -1.0, foot), add(b, -1.0, foot)
    if start > end:
        return disc * _turn(p, q, normal, scale)
    d = add(q, -1.0, p)
    first, last = add(p, start, d), add(p, end, d)
    total = dot(cross(first, last), normal) * scale
    if start > 0:
        total += disc * _turn(p, first, normal, scale)
    if end < 1:
        total += disc * _turn(last, q, normal, scale)
    return total


@kernel
def _turn(p, q, normal, scale):
    """The angle from p to q about the normal."""
    return math.atan2(dot(cross(p, q), normal) * scale, dot(p, q))
