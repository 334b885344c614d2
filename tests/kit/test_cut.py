"""Segments and triangles cut by a ball, against closed forms, additivity and counted points."""

import numpy as np
import pytest

from curvlib.kit.compiled import compiled
from curvlib.kit.cut import segment_within, triangle_within


@compiled
def part_of(a, b, c, radius):
    return triangle_within((a[0], a[1], a[2]), (b[0], b[1], b[2]), (c[0], c[1], c[2]), radius)


@compiled
def piece_of(a, b, radius):
    return segment_within((a[0], a[1], a[2]), (b[0], b[1], b[2]), radius)


def area(a, b, c):
    return np.linalg.norm(np.cross(b - a, c - a)) / 2


def turn(seed):
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return q * np.sign(np.diag(r))


@pytest.mark.parametrize("height", [0.0, 0.3, -0.9, 0.999])
def test_a_disc_within_a_large_triangle(height):
    corners = np.array([[-9, -8, height], [9, -7, height], [0, 11, height]]) @ turn(1).T
    disc = np.pi * (1 - height**2) / area(*corners)
    assert part_of(*corners, 1.0) == pytest.approx(disc, rel=1e-12)
    assert part_of(*corners[[1, 0, 2]], 1.0) == pytest.approx(disc, rel=1e-12)


def test_a_sector_at_a_corner():
    corners = np.array([[0, 0, 0], [5, 0, 0], [2, 6, 0.0]]) @ turn(2).T
    part = np.arctan2(6, 2) / 2 / area(*corners)
    assert part_of(*corners, 1.0) == pytest.approx(part, rel=1e-12)


def test_outside_inside_and_without_area():
    a, b, c = np.array([[2, 0, 0], [3, 0, 0], [2, 1, 0.0]])
    assert part_of(a, b, c, 1.0) == 0
    assert part_of(a, b, c, 2.0) == 0
    assert part_of(a, b, c, 3.0) == 1
    assert part_of(a, b, 2 * b - a, 9.0) == 0
    assert part_of(a, a, b, 9.0) == 0


@pytest.mark.parametrize("seed", range(20))
def test_the_parts_of_a_triangle_add_up(seed):
    """Of four triangles that it is divided into; and the part is that of 10^5 points in it."""
    rng = np.random.default_rng(seed)
    corners = rng.normal(size=(3, 3))
    a, b, c = corners
    p, q, r = a + 0.3 * (b - a), b + 0.6 * (c - b), c + 0.45 * (a - c)
    pieces = [(a, p, r), (p, b, q), (r, q, c), (p, q, r)]
    for radius in (0.5, 1.0, 1.7):
        found = part_of(a, b, c, radius)
        summed = sum(part_of(*piece, radius) * area(*piece) for piece in pieces)
        assert summed == pytest.approx(found * area(a, b, c), abs=1e-12)
        u, v = np.sort(rng.random((2, 100_000)), axis=0)
        points = np.stack((u, v - u, 1 - v), axis=1) @ corners
        assert found == pytest.approx((np.linalg.norm(points, axis=1) < radius).mean(), abs=0.007)


def test_segments():
    a, b = np.array([-3.0, 0.6, 0]), np.array([5.0, 0.6, 0])
    assert piece_of(a, b, 1.0) == pytest.approx(((3 - 0.8) / 8, (3 + 0.8) / 8))
    assert piece_of(a, b, 0.5) == (1, 0)
    assert piece_of(a, b, 9.0) == (0, 1)
    assert piece_of(a, a, 1.0) == (1, 0)
    assert piece_of(0 * a, b, 1.0) == pytest.approx((0, 1 / np.linalg.norm(b)))
