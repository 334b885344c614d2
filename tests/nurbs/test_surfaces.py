"""Exact curvature against geomdl, scipy, mpmath, closed forms and finite differences."""

import mpmath
import numpy as np
import pytest
from scipy.interpolate import NdBSpline

import curvlib

SURFACES = curvlib.surfaces()


def interior(surface, count, seed=0, margin=0.0):
    """Random points inside the domain, off every knot line."""
    (u0, u1), (v0, v1) = surface.domain
    a, b = np.random.default_rng(seed).random((2, count)) * (1 - 2 * margin) + margin
    return u0 + (u1 - u0) * a, v0 + (v1 - v0) * b


def from_derivatives(S_u, S_v, S_uu, S_uv, S_vv):
    """K and H by the classical formulas, arrays (m, 3) in."""
    n = np.cross(S_u, S_v)
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    E, F, G = ((a * b).sum(1) for a, b in ((S_u, S_u), (S_u, S_v), (S_v, S_v)))
    L, M, N = (-(a * n).sum(1) for a in (S_uu, S_uv, S_vv))
    area = E * G - F * F
    return (L * N - M * M) / area, (E * N - 2 * F * M + G * L) / (2 * area), n


def assert_same(found, expected, tolerance):
    """Within a tolerance relative to the principal curvatures, K and H at every point."""
    k = np.abs(expected.H) + np.sqrt(np.maximum(expected.H**2 - expected.K, 0)) + 1e-300
    assert np.all(np.abs(found[0] - expected.K) <= tolerance * k**2)
    assert np.all(np.abs(found[1] - expected.H) <= tolerance * k)


@pytest.mark.parametrize("name", SURFACES)
def test_geomdl_agrees(name):
    s = curvlib.surface(name)
    u, v = interior(s, 60, margin=0.02)
    d = [s.model.derivatives(a, b, order=2) for a, b in zip(u, v)]
    pick = [np.array([x[i][j] for x in d]) for i, j in ((1, 0), (0, 1), (2, 0), (1, 1), (0, 2))]
    exact = s.curvature(u, v)
    K, H, n = from_derivatives(*pick)
    assert exact.smooth.all()
    assert_same((K, H), exact, 1e-10)
    np.testing.assert_allclose(exact.normal, n, atol=1e-10)
    np.testing.assert_allclose(s.point(u, v), [x[0][0] for x in d], atol=1e-13)


@pytest.mark.parametrize("name", SURFACES)
def test_scipy_agrees(name):
    s = curvlib.surface(name)
    u, v = interior(s, 500, seed=1, margin=0.02)
    m = s.model
    knots = (np.array(m.knotvector_u), np.array(m.knotvector_v))
    net = np.reshape(m.ctrlptsw, (m.ctrlpts_size_u, m.ctrlpts_size_v, 4))
    spline = NdBSpline(knots, net, (m.degree_u, m.degree_v))

    def A(*nu):
        return spline(np.column_stack((u, v)), nu=nu)

    w, w_u, w_v = (A(*nu)[:, 3:] for nu in ((0, 0), (1, 0), (0, 1)))
    S = A(0, 0)[:, :3] / w
    S_u, S_v = (A(1, 0)[:, :3] - w_u * S) / w, (A(0, 1)[:, :3] - w_v * S) / w
    S_uu = (A(2, 0)[:, :3] - 2 * w_u * S_u - A(2, 0)[:, 3:] * S) / w
    S_vv = (A(0, 2)[:, :3] - 2 * w_v * S_v - A(0, 2)[:, 3:] * S) / w
    S_uv = (A(1, 1)[:, :3] - w_u * S_v - w_v * S_u - A(1, 1)[:, 3:] * S) / w
    K, H, n = from_derivatives(S_u, S_v, S_uu, S_uv, S_vv)
    exact = s.curvature(u, v)
    assert_same((K, H), exact, 1e-10)
    np.testing.assert_allclose(exact.normal, n, atol=1e-10)


@pytest.mark.parametrize("name", SURFACES)
def test_finite_differences_agree(name):
    s = curvlib.surface(name)
    u, v = interior(s, 200, seed=2, margin=0.05)
    h = 1e-4
    P = {(i, j): s.point(u + i * h, v + j * h) for i in (-1, 0, 1) for j in (-1, 0, 1)}
    K, H, _ = from_derivatives(
        (P[1, 0] - P[-1, 0]) / (2 * h),
        (P[0, 1] - P[0, -1]) / (2 * h),
        (P[1, 0] - 2 * P[0, 0] + P[-1, 0]) / h**2,
        (P[1, 1] - P[1, -1] - P[-1, 1] + P[-1, -1]) / (4 * h**2),
        (P[0, 1] - 2 * P[0, 0] + P[0, -1]) / h**2,
    )
    exact = s.curvature(u, v)
    k = np.maximum(np.abs(exact.k1), np.abs(exact.k2))
    # Not where the step straddles a knot line: there it mixes two pieces.
    assert np.mean(np.abs(K - exact.K) <= 1e-3 * k**2) > 0.97
    assert np.mean(np.abs(H - exact.H) <= 1e-3 * k) > 0.97


@pytest.mark.parametrize("name", SURFACES)
def test_normals_point_outward(name):
    """The volume inside is positive, the open ends closed by a cone to their own centre."""
    s = curvlib.surface(name)
    m = curvlib.tessellate(s, 24)
    across = 1 - s.closed.index(True)
    triangles = m.vertices[m.faces]
    ends = m.uv[m.faces, across]
    caps = []
    for end in s.domain[across]:
        for k in range(3):
            edge = (ends[:, [k, (k + 1) % 3]] == end).all(1)
            a, b = triangles[edge, k], triangles[edge, (k + 1) % 3]
            if edge.any():
                caps.append(np.stack((b, a, np.broadcast_to(a.mean(0), a.shape)), 1))
    closed = np.concatenate((triangles, *caps))
    assert np.linalg.det(closed).sum() > 0
    flat = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    along = np.nansum(flat[:, None] * m.normals[m.faces], axis=(1, 2))
    assert (along > 0).mean() > 0.98


@pytest.mark.parametrize("name", SURFACES)
def test_invariants(name):
    s = curvlib.surface(name)
    c = s.curvature(*interior(s, 400, seed=3))
    assert c.smooth.all()
    assert (c.k1 >= c.k2).all()
    np.testing.assert_allclose(np.linalg.norm(c.normal, axis=1), 1, atol=1e-14)
    k = np.maximum(np.abs(c.k1), np.abs(c.k2))
    assert np.all(np.abs(c.k1 * c.k2 - c.K) <= 1e-13 * k * k)
    assert np.all(np.abs((c.k1 + c.k2) / 2 - c.H) <= 1e-13 * k)


# Points of every kind: anywhere, on seams, knot lines and poles, and close to poles.
EVERYWHERE = (
    np.r_[np.random.default_rng(4).random(300), np.linspace(0, 1, 17)],
    np.r_[0, 1e-9, 1e-4, 0.25, 0.5, 0.75, 1 - 1e-4, 1 - 1e-9, 1, np.linspace(0, 1, 51)][:, None],
)


def ellipsoid_form(p):
    """K and H of (x/a)^2 + (y/b)^2 + (z/c)^2 = 1 at p."""
    a2 = np.square([1.5, 1.0, 0.75])
    K = 1 / (a2.prod() * ((p / a2) ** 2).sum(-1) ** 2)
    H = (a2.sum() - (p**2).sum(-1)) / (2 * a2.prod() * ((p / a2) ** 2).sum(-1) ** 1.5)
    return K, H


CLOSED_FORMS = {
    "cylinder": lambda p: (0 * p[..., 0], 0 * p[..., 0] + 0.5),
    "cone": lambda p: (0 * p[..., 0], 1.5 / np.hypot(1.5, 0.6) / (2 * np.hypot(*p.T[:2]).T)),
    "sphere": lambda p: (1 + 0 * p[..., 0], 1 + 0 * p[..., 0]),
    "ellipsoid": ellipsoid_form,
}


@pytest.mark.parametrize("name", CLOSED_FORMS)
def test_closed_forms(name):
    s = curvlib.surface(name)
    exact = s.curvature(*EVERYWHERE)
    K, H = CLOSED_FORMS[name](s.point(*EVERYWHERE))
    assert exact.smooth.all()
    np.testing.assert_allclose(exact.H, H, rtol=1e-12)
    np.testing.assert_allclose(exact.K, K, rtol=1e-12, atol=1e-12 * np.abs(H).max() ** 2)


def mp_basis(degree, knots, i, t):
    """Cox-de Boor recursion at mpmath's precision."""
    if degree == 0:
        return mpmath.mpf(knots[i] <= t < knots[i + 1])
    value = mpmath.mpf(0)
    if knots[i + degree] > knots[i]:
        left = (t - knots[i]) / (knots[i + degree] - knots[i])
        value += left * mp_basis(degree - 1, knots, i, t)
    if knots[i + degree + 1] > knots[i + 1]:
        right = (knots[i + degree + 1] - t) / (knots[i + degree + 1] - knots[i + 1])
        value += right * mp_basis(degree - 1, knots, i + 1, t)
    return value


def mp_curvature(model, u, v):
    """K and H of a polynomial B-spline surface: the basis differentiated numerically."""

    def basis(degree, knots, count, t):
        knots, t = [mpmath.mpf(x) for x in knots], mpmath.mpf(t)
        return [
            [
                mpmath.diff(lambda x, i=i: mp_basis(degree, knots, i, x), t, order, h=1e-20)
                for i in range(count)
            ]
            for order in range(3)
        ]

    def dot(x, y):
        return mpmath.fsum(a * b for a, b in zip(x, y))

    N = basis(model.degree_u, model.knotvector_u, model.ctrlpts_size_u, u)
    M = basis(model.degree_v, model.knotvector_v, model.ctrlpts_size_v, v)
    net = np.reshape(model.ctrlpts, (len(N[0]), len(M[0]), 3))
    S = {
        (a, b): [
            mpmath.fsum(x * y * p for x, row in zip(N[a], net[..., c]) for y, p in zip(M[b], row))
            for c in range(3)
        ]
        for a, b in ((1, 0), (0, 1), (2, 0), (1, 1), (0, 2))
    }
    S_u, S_v = S[1, 0], S[0, 1]
    n = [S_u[i - 2] * S_v[i - 1] - S_u[i - 1] * S_v[i - 2] for i in range(3)]
    length = mpmath.sqrt(dot(n, n))
    E, F, G = dot(S_u, S_u), dot(S_u, S_v), dot(S_v, S_v)
    L, M, N = (-dot(S[ab], n) / length for ab in ((2, 0), (1, 1), (0, 2)))
    area = E * G - F**2
    return (L * N - M**2) / area, (E * N - 2 * F * M + G * L) / (2 * area)


@pytest.mark.parametrize("name", ["teapot_body", "teapot_spout"])
def test_fifty_digits_agree(name):
    s = curvlib.surface(name)
    for u, v in zip(*interior(s, 6, seed=5, margin=0.01)):
        with mpmath.workdps(50):
            K, H = map(float, mp_curvature(s.model, u, v))
        exact = s.curvature(u, v)
        assert_same((K, H), exact, 1e-12)
        assert (exact.K, exact.H) == pytest.approx((K, H), rel=1e-10)


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


def test_revolution_has_both_signs():
    s = curvlib.surface("revolution")
    K = s.curvature(0.1, np.linspace(0, 1, 101)).K
    assert K.min() < -1
    assert K.max() > 1


def test_flat_pieces_that_meet_in_rounding_are_smooth():
    """K of 1e-17 on one side and -1e-17 on the other is one value; a crease is not."""
    from curvlib.nurbs.surface import Surface
    from curvlib.surfaces._shapes import nurbs

    def bent(height):
        net = np.array(
            [[(x + 0.1 * y, y, z) for y in (0, 0.7, 1)] for x, z in ((0, 0), (0.3, 0), (1, height))]
        )
        return Surface(nurbs((1, 2), ([0, 0, 0.4, 1, 1], [0, 0, 0, 1, 1, 1]), net))

    assert bent(0).curvature(0.4, 0.3).smooth
    creased = bent(0.5).curvature([0.4, 0.41], 0.3)
    assert creased.smooth.tolist() == [False, True]
    assert np.isnan(creased.normal[0]).all()


def test_both_poles_in_one_span():
    """A single cubic arc from pole to pole: every u agrees at the poles, and near them."""
    from curvlib.nurbs.surface import Surface
    from curvlib.surfaces._shapes import revolve

    arc = [(0, -1), (4 / 3, -1), (4 / 3, 1), (0, 1)]
    s = Surface(revolve(3, [0, 0, 0, 0, 1, 1, 1, 1], arc))
    pole, near = (s.curvature(np.linspace(0, 1, 13), v) for v in (1.0, 1 - 1e-7))
    assert pole.smooth.all()
    np.testing.assert_allclose(near.K, pole.K, rtol=1e-5)
    np.testing.assert_allclose(near.H, pole.H, rtol=1e-5)
    np.testing.assert_allclose(pole.normal, [[0, 0, 1]] * 13, atol=1e-12)


def test_both_poles_in_one_point():
    """Closed meridians: at each of their ends the pole has the values beside it."""
    from curvlib.nurbs.surface import Surface
    from curvlib.surfaces._shapes import revolve

    loop = [(0, 0), (1, 0), (2, 2), (0.5, 0), (0, 0)]
    s = Surface(revolve(4, [0] * 5 + [1] * 5, loop))
    for v, beside in ((0.0, 1e-7), (1.0, 1 - 1e-7)):
        pole, near = s.curvature(0.1, v), s.curvature(0.1, beside)
        assert pole.smooth
        assert near.K == pytest.approx(float(pole.K), rel=1e-4)
        assert near.H == pytest.approx(float(pole.H), rel=1e-4)


@pytest.mark.parametrize("bad", [(1.5, 0.5), (-0.1, 0.5), (np.nan, 0.5)])
def test_outside_the_domain(bad):
    with pytest.raises(curvlib.InputError, match=r"u = .* outside the domain \[0, 1\].*'sphere'"):
        curvlib.surface("sphere").curvature(*bad)


def test_shapes_broadcast():
    s = curvlib.surface("sphere")
    c = s.curvature(np.zeros((4, 1)), np.zeros(3) + 0.3)
    assert c.K.shape == c.smooth.shape == (4, 3)
    assert c.normal.shape == s.point(np.zeros((4, 1)), np.zeros(3)).shape == (4, 3, 3)
    assert s.curvature(0.1, 0.2).K.shape == ()


def test_unknown_surface_names_the_nearest():
    with pytest.raises(curvlib.InputError, match="unknown surface 'sphre'; did you mean 'sphere'"):
        curvlib.surface("sphre")
