"""Exact curvature against geomdl, SciPy, closed forms and finite differences."""

import numpy as np
import pytest
from oracle import assert_same, from_derivatives, from_scipy

import curvlib


def test_geomdl_agrees(surface, interior):
    s = surface
    u, v = interior(s, 60, margin=0.02)
    d = [s.model.derivatives(a, b, order=2) for a, b in zip(u, v)]
    pick = [np.array([x[i][j] for x in d]) for i, j in ((1, 0), (0, 1), (2, 0), (1, 1), (0, 2))]
    exact = s.curvature(u, v)
    K, H, n = from_derivatives(*pick)
    assert exact.smooth.all()
    assert_same((K, H), exact, 1e-10)
    np.testing.assert_allclose(exact.normal, n, atol=1e-10)
    np.testing.assert_allclose(s.point(u, v), [x[0][0] for x in d], atol=1e-13)
    np.testing.assert_array_equal(exact.point, s.point(u, v))


def test_scipy_agrees(surface, interior):
    u, v = interior(surface, 500, seed=1, margin=0.02)
    S, K, H, n = from_scipy(surface.model, u, v)
    exact = surface.curvature(u, v)
    assert_same((K, H), exact, 1e-10)
    np.testing.assert_allclose(exact.normal, n, atol=1e-10)
    np.testing.assert_allclose(exact.point, S, atol=1e-13)


def test_finite_differences_agree(surface, interior):
    s = surface
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
    # A step across a knot line mixes two pieces.
    apart = [np.abs(t[:, None] - breaks).min(1) > h for t, breaks in zip((u, v), s.breaks)]
    inside = apart[0] & apart[1]
    assert inside.mean() > 0.97
    assert np.all((np.abs(K - exact.K) <= 1e-3 * k**2)[inside])
    assert np.all((np.abs(H - exact.H) <= 1e-3 * k)[inside])


def test_normals_point_outward(surface):
    """The volume inside is positive, the open ends closed by a cone to their own centre."""
    s = surface
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


def test_invariants(surface, interior):
    c = surface.curvature(*interior(surface, 400, seed=3))
    assert c.smooth.all()
    assert (c.k1 >= c.k2).all()
    np.testing.assert_allclose(np.linalg.norm(c.normal, axis=1), 1, atol=1e-14)
    k = np.maximum(np.abs(c.k1), np.abs(c.k2))
    assert np.all(np.abs(c.k1 * c.k2 - c.K) <= 1e-13 * k * k)
    assert np.all(np.abs((c.k1 + c.k2) / 2 - c.H) <= 1e-13 * k)


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
def test_closed_forms(name, everywhere):
    s = curvlib.surface(name)
    exact = s.curvature(*everywhere)
    K, H = CLOSED_FORMS[name](s.point(*everywhere))
    assert exact.smooth.all()
    np.testing.assert_allclose(exact.H, H, rtol=1e-12)
    np.testing.assert_allclose(exact.K, K, rtol=1e-12, atol=1e-12 * np.abs(H).max() ** 2)
