"""The ends of the domain: seams, poles and edges of surfaces however they are written."""

import itertools

import numpy as np
import pytest
from oracle import assert_same, from_scipy
from scipy.interpolate import BSpline

import curvlib
from curvlib.nurbs.tessellation import DIAGONALS
from curvlib.surfaces._shapes import nurbs

LINE = [0, 0, 1, 1]


def parts(model):
    """Degrees, knots, net and weights of a geomdl surface."""
    shape = (model.ctrlpts_size_u, model.ctrlpts_size_v)
    knots = [np.array(k, float) for k in (model.knotvector_u, model.knotvector_v)]
    net, weights = np.reshape(model.ctrlpts, (*shape, 3)), np.reshape(model.weights, shape)
    return model.degree, knots, net, weights


def unclamped(model):
    """The same surface with outer knots apart, by collocation."""
    degrees, knots, net, weights = parts(model)
    net = np.concatenate((net * weights[..., None], weights[..., None]), -1)
    for axis, (p, k) in enumerate(zip(degrees, knots)):
        steps = 0.3 * np.diff(k).max() * np.arange(1, p + 1)
        new = np.r_[k[0] - steps[::-1], k[p : len(k) - p], k[-1] + steps]
        spans = itertools.pairwise(np.unique(k))
        t = np.concatenate([a + (b - a) * (np.arange(p + 1) + 0.5) / (p + 1) for a, b in spans])
        before, after = (BSpline.design_matrix(t, x, p).toarray() for x in (k, new))
        net = np.moveaxis(np.tensordot(np.linalg.lstsq(after, before)[0], net, (1, axis)), 0, axis)
        knots[axis] = new
    return curvlib.Surface(nurbs(degrees, knots, net[..., :3] / net[..., 3:], net[..., 3]))


def moved(surface, offset):
    """The surface turned, its centre at a point that far off."""
    degrees, knots, net, weights = parts(surface.model)
    turn = np.linalg.qr(np.random.default_rng(7).normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    return curvlib.Surface(nurbs(degrees, knots, net @ turn + np.array(offset), weights))


def grid(surface, count=33):
    """Parameters with all edges and knot lines."""
    u, v = (
        np.unique(np.r_[np.linspace(b[0], b[-1], count), b, (b[1:] + b[:-1]) / 2])
        for b in surface.breaks
    )
    return u[:, None], v


def test_unclamped_knots_do_not_change_a_surface(surface):
    other = unclamped(surface.model)
    assert other.closed == surface.closed
    for edge in itertools.product((0, 1), (0, -1)):
        assert other.has_pole(*edge) == surface.has_pole(*edge)
    at = grid(surface)
    found, exact = other.curvature(*at), surface.curvature(*at)
    np.testing.assert_allclose(found.point, exact.point, atol=1e-12)
    np.testing.assert_array_equal(found.smooth, exact.smooth)
    smooth = exact.smooth
    k = np.maximum(np.abs(exact.k1), np.abs(exact.k2))[smooth]
    assert np.all(np.abs(found.K - exact.K)[smooth] <= 1e-8 * k * k)
    assert np.all(np.abs(found.H - exact.H)[smooth] <= 1e-8 * k)


def test_unclamped_surfaces_are_those_of_scipy(build):
    """Rational, with a knot of multiplicity two; up to the ends of the domain."""
    knots = [0, 0.3, 1, 1.5, 2, 2, 3, 3.2, 4, 5], [-1, 0, 1, 1.2, 2, 3, 4]
    rng = np.random.default_rng(7)
    u, v = np.r_[1.5, 3.0, rng.uniform(1.5, 3.0, 200)], np.r_[2, 1, rng.uniform(1, 2, 200)]
    x, y = np.meshgrid(np.arange(6), np.arange(4), indexing="ij")
    net = np.stack((x, y, rng.normal(size=x.shape)), -1)
    s = build((3, 2), knots, net, rng.uniform(0.5, 2, x.shape))
    assert s.domain == ((1.5, 3.0), (1.0, 2.0))
    assert s.closed == (False, False)
    S, K, H, n = from_scipy(s.model, u, v)
    exact = s.curvature(u, v)
    np.testing.assert_allclose(exact.point, S, atol=1e-13)
    np.testing.assert_allclose(exact.normal, n, atol=1e-12)
    assert_same((K, H), exact, 1e-11)


def test_equal_rows_of_an_unclamped_net_are_no_seam(build):
    x, y = np.meshgrid(np.arange(7.0), np.arange(7.0), indexing="ij")
    net = np.stack((x, y, np.sin(2 * x + y)), -1)
    net[-1] = net[0]
    s = build((3, 3), (range(11), [0] * 4 + [1, 2, 3] + [4] * 4), net)
    assert s.closed == (False, False)
    assert s.curvature([3, 7], 1.3).smooth.all()
    assert curvlib.tessellate(s, 8).boundary.sum() == 32


def torus(count=8, degrees=(3, 3), weights=1.0):
    """Net wrapped round, uniform knots: periodic in both directions."""
    a = 2 * np.pi * np.arange(count) / count
    tube = np.stack((3 + np.cos(a), np.sin(a)), -1)
    net = np.array([[(r * np.cos(b), r * np.sin(b), z) for r, z in tube] for b in a])
    wrapped = (0, degrees[0]), (0, degrees[1])
    net = np.pad(net, (*wrapped, (0, 0)), mode="wrap")
    weights = np.pad(np.broadcast_to(weights, (count, count)), wrapped, mode="wrap")
    knots = [range(count + 2 * p + 1) for p in degrees]
    return curvlib.Surface(nurbs(degrees, knots, net, weights))


@pytest.mark.parametrize("diagonal", DIAGONALS)
def test_a_periodic_torus_is_closed(diagonal):
    s = torus()
    assert s.closed == (True, True)
    assert s.curvature(*grid(s)).smooth.all()
    mesh = curvlib.tessellate(s, 12, diagonal)
    assert not mesh.boundary.any()
    assert len(mesh.vertices) - 3 * len(mesh.faces) // 2 + len(mesh.faces) == 0
    assert mesh.smooth.all()
    # Turning about the axis by one span of u is a symmetry.
    u, v = np.linspace(3, 10, 29), np.linspace(3, 11, 33)[:, None]
    np.testing.assert_allclose(s.curvature(u, v).K, s.curvature(u + 1, v).K, atol=1e-12)


def test_a_periodic_surface_is_as_smooth_as_its_degrees():
    """Weights without symmetry: of degree 3 it is C^2 across seams and knots, of degree 2 not."""
    weights = np.random.default_rng(7).uniform(0.7, 1.4, (8, 8))
    for degrees in ((3, 3), (3, 2)):
        s = torus(degrees=degrees, weights=weights)
        assert s.closed == (True, True)
        u, v = grid(s)
        on_knot = np.isin(v, s.breaks[1]) & (degrees[1] == 2)
        assert on_knot.sum() == (9 if degrees[1] == 2 else 0)
        smooth = s.curvature(u, v).smooth
        np.testing.assert_array_equal(smooth, np.broadcast_to(~on_knot, smooth.shape))


PRISM = np.array([(1, 0), (0, 1), (-1, -1), (1, 0)])  # its corners, the first one twice


def prism(build, weights, heights):
    """Degree 1 around, 2 upwards; weights and heights (4, 3)."""
    net = [[(x, y, z) for z in row] for (x, y), row in zip(PRISM, heights)]
    return build((1, 2), ([0, 0, 1, 2, 3, 3], [0, 0, 0, 1, 1, 1]), net, weights)


def test_seams_are_told_by_weights(build):
    """The same control points: a seam under the same weights, or all scaled by one factor."""
    heights, weights = np.tile([0, 0.5, 1.0], (4, 1)), np.ones((4, 3))
    for last, closed in (((1, 1, 1), True), ((3, 3, 3), True), ((1, 1.3, 1), False)):
        weights[-1] = last
        s = prism(build, weights, heights)
        assert s.closed[0] == closed
        edges = s.point(0, [0.2, 0.7]), s.point(3, [0.2, 0.7])
        assert np.allclose(*edges, atol=1e-12) == closed


def test_seams_are_told_by_curves_and_not_by_control_points(build):
    """z = t as t (1 + t) / (1 + t)."""
    heights, weights = np.tile([0, 0.5, 1.0], (4, 1)), np.ones((4, 3))
    heights[-1], weights[-1] = (0, 1 / 3, 1), (1, 1.5, 2)
    assert prism(build, weights, heights).closed == (True, False)


def test_a_surface_torn_by_a_knot(build):
    """Multiplicity above the degree: two surfaces, unless both sides meet."""
    net = np.array([[(x, y, x * y) for y in (0.0, 1.0)] for x in (0.0, 1.0, 1.0, 2.0)])
    whole = build((1, 1), ([0, 0, 1, 1, 2, 2], LINE), net)
    plain = build((1, 1), ([0, 0, 1, 2, 2], LINE), net[[0, 1, 3]])
    at = np.linspace(0, 2, 9)[:, None], np.linspace(0, 1, 5)
    np.testing.assert_allclose(whole.point(*at), plain.point(*at), atol=1e-15)
    np.testing.assert_array_equal(whole.curvature(*at).smooth, plain.curvature(*at).smooth)
    net[2:, :, 2] += 0.1
    with pytest.raises(curvlib.InputError, match=r"'mine' is torn along u = 1\.0"):
        build((1, 1), ([0, 0, 1, 1, 2, 2], LINE), net, name="mine")


@pytest.mark.parametrize("offset", [(0, 0, 0), (1e3, 2e3, -3e3), (1e6, -4e5, 3e5), (3e7, 0, 1e7)])
def test_far_from_the_origin(surface, offset):
    """Coordinates are rounded to 1e-16 of themselves; topology and curvature stay."""
    far, rounding = moved(surface, offset), 1e-15 * np.abs(offset).max()
    assert far.closed == surface.closed
    at = grid(surface)
    found, exact = far.curvature(*at), surface.curvature(*at)
    np.testing.assert_array_equal(found.smooth, exact.smooth)
    smooth = exact.smooth
    k = np.maximum(np.abs(exact.k1), np.abs(exact.k2))[smooth] + 1
    bound = (1e-9 + 1e3 * rounding) * k
    assert np.all(np.abs(found.H - exact.H)[smooth] <= bound)
    assert np.all(np.abs(found.K - exact.K)[smooth] <= bound * k)
    np.testing.assert_array_equal(np.isnan(found.d1), np.isnan(exact.d1))
    assert len(curvlib.tessellate(far, 8).faces) == len(curvlib.tessellate(surface, 8).faces)


def test_beside_a_pole_far_from_the_origin():
    """A rounded net bends by its rounding over the distance from the pole."""
    c = moved(curvlib.surface("sphere"), (1e6, 2e6, -1e6)).curvature(0.1, [0, 1e-9, 1 - 1e-7, 1])
    np.testing.assert_allclose(c.K, 1, rtol=1e-5)
    np.testing.assert_allclose(c.H, 1, rtol=1e-5)
