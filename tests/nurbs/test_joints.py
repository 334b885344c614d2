"""Where pieces of a surface meet, and at its poles."""

import numpy as np
import pytest

import curvlib
from curvlib.surfaces._shapes import nurbs, revolve


def test_cone_apex_is_undefined_there_alone():
    s = curvlib.surface("cone_apex")
    c = s.curvature(np.linspace(0, 1, 9)[:, None], [0.0, 0.5, 1 - 1e-9, 1.0])
    assert c.smooth[:, :3].all()
    assert np.isfinite(c.K[:, :3]).all()
    assert not c.smooth[:, 3].any()
    for value in (c.K, c.H, c.k1, c.k2, c.normal):
        assert np.isnan(value[:, 3]).all()


@pytest.mark.parametrize(("name", "rows"), [("teapot_body", [1, 2]), ("teapot_spout", [1])])
def test_teapot_is_not_smooth_at_its_joints(name, rows):
    """One-sided K and H differ; the normal is common, and the mirror seams in v are smooth."""
    s = curvlib.surface(name)
    v = np.linspace(*s.domain[1], 17)
    for u in rows:
        c = s.curvature(u, v)
        assert not c.smooth.any()
        assert np.isnan(c.K).all()
        assert np.isfinite(c.normal).all()
        near = [s.curvature(u + side * 1e-9, v) for side in (-1, 1)]
        assert all(c.smooth.all() for c in near)
        assert (np.abs(near[0].K - near[1].K) > 0.1).any()
    between = s.curvature((np.arange(40) + 0.5)[:, None] / 40 * s.domain[0][1], v)
    assert between.smooth.all()


def test_spout_has_the_extremes_of_its_lip():
    """K of the lip and of the tube as measured on their own (reading of the surface, section 2)."""
    s = curvlib.surface("teapot_spout")
    v = np.linspace(0, 2, 201)
    lip = s.curvature(np.linspace(1 + 1e-9, 2, 401)[:, None], v).K
    tube = curvlib.surface("teapot_spout_tube").curvature(np.linspace(0, 1, 201)[:, None], v).K
    assert lip.min() == pytest.approx(-1563, rel=0.02)
    assert lip.max() == pytest.approx(3654, rel=0.01)
    assert (tube.min(), tube.max()) == pytest.approx((-7.86, 9.18), rel=0.01)


@pytest.mark.parametrize(
    ("part", "whole", "low", "high"),
    [("teapot_spout_tube", "teapot_spout", 0, 1), ("teapot_body_wall", "teapot_body", 1, 2)],
)
def test_a_smooth_part_is_the_whole_between_its_joints(part, whole, low, high):
    part, whole = curvlib.surface(part), curvlib.surface(whole)
    assert part.domain == ((low, high), whole.domain[1])
    u, v = np.linspace(low, high, 13), np.linspace(*whole.domain[1], 17)
    np.testing.assert_allclose(part.point(u[:, None], v), whole.point(u[:, None], v), atol=1e-13)
    inside, ends = (part.curvature(t[:, None], v) for t in (u[1:-1], u[[0, -1]]))
    expected = whole.curvature(u[1:-1, None], v)
    np.testing.assert_allclose(inside.K, expected.K, rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(inside.H, expected.H, rtol=1e-10, atol=1e-12)
    assert inside.smooth.all()
    assert ends.smooth.all()


def test_the_wall_leaves_the_steep_parts_of_the_body_out():
    """|H| as in the docstring of `teapot_body_wall`."""

    def largest(name, low, high):
        u, v = np.linspace(low, high, 401)[:, None], np.linspace(0, 4, 65)
        return np.nanmax(abs(curvlib.surface(name).curvature(u, v).H))

    assert largest("teapot_body", 0, 1) == pytest.approx(26.3, abs=0.05)
    assert largest("teapot_body", 2, 3) == pytest.approx(29.4, abs=0.05)
    assert largest("teapot_body_wall", 1, 2) == pytest.approx(0.67, abs=0.005)


def test_revolution_has_both_signs():
    s = curvlib.surface("revolution")
    K = s.curvature(0.1, np.linspace(0, 1, 101)).K
    assert K.min() < -1
    assert K.max() > 1


def test_flat_pieces_that_meet_in_rounding_are_smooth(build):
    """K of 1e-17 on one side and -1e-17 on the other is one value; a crease is not."""

    def bent(height):
        net = np.array(
            [[(x + 0.1 * y, y, z) for y in (0, 0.7, 1)] for x, z in ((0, 0), (0.3, 0), (1, height))]
        )
        return build((1, 2), ([0, 0, 0.4, 1, 1], [0, 0, 0, 1, 1, 1]), net)

    assert bent(0).curvature(0.4, 0.3).smooth
    creased = bent(0.5).curvature([0.4, 0.41], 0.3)
    assert creased.smooth.tolist() == [False, True]
    assert np.isnan(creased.normal[0]).all()


def test_both_poles_in_one_span():
    """A single cubic arc from pole to pole: every u agrees at the poles, and near them."""
    arc = [(0, -1), (4 / 3, -1), (4 / 3, 1), (0, 1)]
    s = curvlib.Surface(revolve(3, [0, 0, 0, 0, 1, 1, 1, 1], arc))
    pole, near = (s.curvature(np.linspace(0, 1, 13), v) for v in (1.0, 1 - 1e-7))
    assert pole.smooth.all()
    np.testing.assert_allclose(near.K, pole.K, rtol=1e-5)
    np.testing.assert_allclose(near.H, pole.H, rtol=1e-5)
    np.testing.assert_allclose(pole.normal, [[0, 0, 1]] * 13, atol=1e-12)


def test_both_poles_in_one_point():
    """Closed meridians: at each of their ends the pole has the values beside it."""
    loop = [(0, 0), (1, 0), (2, 2), (0.5, 0), (0, 0)]
    s = curvlib.Surface(revolve(4, [0] * 5 + [1] * 5, loop))
    for v, beside in ((0.0, 1e-7), (1.0, 1 - 1e-7)):
        pole, near = s.curvature(0.1, v), s.curvature(0.1, beside)
        assert pole.smooth
        assert near.K == pytest.approx(float(pole.K), rel=1e-4)
        assert near.H == pytest.approx(float(pole.H), rel=1e-4)


@pytest.mark.parametrize("bend", [0.0, 0.7])
def test_equal_K_and_H_with_other_forms_are_not_smooth(build, bend):
    """z = x^2 + 2 bend |x| y - y^2: at the origin, where four pieces meet, the normal, K and H of
    all are common; a crease leads there along x = 0."""
    ends = [(-1, -1), (-1, 0), (0, 0), (0, 1), (1, 1)]  # the polar form's arguments
    net = [
        [(a + b, c + d, a * b - c * d + bend * abs(a + b) * (c + d) / 2) for c, d in ends]
        for a, b in ends
    ]
    knots = [-1, -1, -1, 0, 0, 1, 1, 1]
    s = build((2, 2), (knots, knots), np.array(net) / [2, 2, 1])
    near = s.curvature([-1e-9, 1e-9], [[-1e-9], [1e-9]])
    np.testing.assert_allclose(near.K, -4 - 4 * bend**2, rtol=1e-7)
    np.testing.assert_allclose(near.H, 0, atol=1e-7)
    c = s.curvature(0, [0, 0.5])
    assert np.isfinite(c.normal[0]).all()
    assert c.smooth.tolist() == [bend == 0, bend == 0]
    assert np.isnan(c.normal[1]).all() == (bend != 0)


@pytest.mark.parametrize("scale", [1e-14, 1e14])
def test_poles_do_not_depend_on_the_unit_of_the_parameters(scale):
    m = curvlib.surface("ellipsoid").model
    net, weights = (np.reshape(a, (9, 5, -1)) for a in (m.ctrlpts, m.weights))
    knots = [scale * np.array(k) for k in (m.knotvector_u, m.knotvector_v)]
    c = curvlib.Surface(nurbs(m.degree, knots, net, weights[..., 0])).curvature(0, [0, scale])
    assert c.smooth.all()
    # Axes a = 1.5, b = 1, c = 0.75: k = c / a^2 and c / b^2.
    np.testing.assert_allclose(c.K, 0.75**2 / 1.5**2, rtol=1e-12)
