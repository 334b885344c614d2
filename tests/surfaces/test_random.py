"""Random shapes are what their proportions say, against closed forms."""

import numpy as np
import pytest

import curvlib
from curvlib.surfaces._random import FAMILIES, random_shapes

SHAPES = list(random_shapes(6))


def of(family):
    return [shape for shape in SHAPES if shape.family == family]


def numbers(proportions):
    """`radii=1 2, height=3` as a dict of arrays."""
    pairs = (words.split("=") for words in proportions.split(", "))
    return {name: np.array(values.split(), float) for name, values in pairs}


def test_draws_are_the_same_again_and_begin_alike():
    found = [shape[:3] for shape in SHAPES]
    assert found == [shape[:3] for shape in random_shapes(6)]
    assert [shape[:3] for shape in random_shapes(2)] == [s for s in found if s[1] <= 2]
    others = {shape.proportions for shape in random_shapes(6, seed=1)}
    assert len(others) == 6 * len(FAMILIES)
    assert others.isdisjoint(shape.proportions for shape in SHAPES)
    names = [f"{family}-{number:02d}" for family in FAMILIES for number in range(1, 7)]
    assert [shape.surface.name for shape in SHAPES] == names


@pytest.mark.parametrize("shape", SHAPES, ids=lambda shape: shape.surface.name)
def test_lengths_lie_in_a_decade_and_curvature_is_everywhere(shape):
    for name, values in numbers(shape.proportions).items():
        size = values[-1:] / 2 if name.startswith("height") else values
        assert ((size >= 0.316) & (size <= 3.163)).all()
    m = curvlib.tessellate(shape.surface, 16)
    assert m.smooth.all()
    assert ((m.vertices * m.normals)[:, :2].sum(1) >= -1e-12).all(), "the normal points outward"


@pytest.mark.parametrize("shape", of("ellipsoid"), ids=lambda shape: shape.proportions)
def test_ellipsoids(shape):
    a, b, c = numbers(shape.proportions)["semi-axes"]
    m = curvlib.tessellate(shape.surface, 12)
    x, y, z = m.vertices.T
    np.testing.assert_allclose((x / a) ** 2 + (y / b) ** 2 + (z / c) ** 2, 1, rtol=1e-12)
    s = (x / a**2) ** 2 + (y / b**2) ** 2 + (z / c**2) ** 2
    np.testing.assert_allclose(m.K, 1 / (a * b * c * s) ** 2, rtol=1e-9)


@pytest.mark.parametrize("shape", of("cylinder"), ids=lambda shape: shape.proportions)
def test_cylinders(shape):
    found = numbers(shape.proportions)
    m = curvlib.tessellate(shape.surface, 12)
    np.testing.assert_allclose(np.hypot(*m.vertices.T[:2]), found["radius"][0], rtol=1e-12)
    assert np.ptp(m.vertices[:, 2]) == pytest.approx(found["height"][0])
    np.testing.assert_allclose(m.H, 1 / (2 * found["radius"][0]), rtol=1e-10)


@pytest.mark.parametrize("shape", of("frustum"), ids=lambda shape: shape.proportions)
def test_frusta(shape):
    found = numbers(shape.proportions)
    (r0, r1), (height,) = found["radii"], found["height"]
    m = curvlib.tessellate(shape.surface, 12)
    r, z = np.hypot(*m.vertices.T[:2]), m.vertices[:, 2]
    np.testing.assert_allclose(r, r0 + (r1 - r0) * z / height, rtol=1e-12)
    np.testing.assert_allclose(m.H, height / np.hypot(height, r1 - r0) / (2 * r), rtol=1e-10)


@pytest.mark.parametrize("shape", of("arc"), ids=lambda shape: shape.proportions)
def test_arcs(shape):
    """Bernstein polynomials of the control points; curvature from r(z) by finite differences."""
    found = numbers(shape.proportions)
    t = np.linspace(0, 1, 2001)
    weights = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3]
    r, z = (sum(w * x for w, x in zip(weights, found[name])) for name in ("radii", "heights"))
    c = shape.surface.curvature(0.1, t)
    np.testing.assert_allclose(np.hypot(*c.point.T[:2]), r, rtol=1e-12)
    np.testing.assert_allclose(c.point[:, 2], z, atol=1e-12)
    assert r.min() >= found["radii"].min() >= 0.316
    dr, dz = np.gradient(r, t, edge_order=2), np.gradient(z, t, edge_order=2)
    ddr, ddz = np.gradient(dr, t, edge_order=2), np.gradient(dz, t, edge_order=2)
    speed = np.hypot(dr, dz)
    along, around = (dr * ddz - dz * ddr) / speed**3, dz / (r * speed)
    inner = slice(20, -20)
    scale = np.abs([along, around]).max(0)[inner] ** 2
    assert (np.abs(c.K - along * around)[inner] <= 1e-3 * scale + 1e-6).all()
