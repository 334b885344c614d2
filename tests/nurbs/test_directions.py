"""Principal directions: against the turning normal, symmetries and closed forms."""

import numpy as np
import pytest

import curvlib


def assert_principal(s, u, v, tolerance):
    """d1, d2, normal are an orthonormal right-handed frame, and dn(d) = k d along d1 and d2 by
    finite differences of the normal."""
    c = s.curvature(u, v)
    assert np.isfinite(c.d1).all()
    frame = np.stack((c.d1, c.d2, c.normal), axis=-2)
    np.testing.assert_allclose(frame @ frame.mT, np.broadcast_to(np.eye(3), frame.shape), atol=1e-9)
    assert np.all(np.linalg.det(frame) > 0)
    h = 1e-5
    steps = ((h, 0), (0, h))
    dS, dn = (
        np.stack([(f(u + a, v + b) - f(u - a, v - b)) / (2 * h) for a, b in steps], axis=-1)
        for f in (s.point, s.normal)
    )
    scale = np.maximum(np.abs(c.k1), np.abs(c.k2))[:, None]
    for k, d in ((c.k1, c.d1), (c.k2, c.d2)):
        parameters = np.linalg.pinv(dS) @ d[..., None]
        turned = (dn @ parameters)[..., 0]
        assert np.all(np.abs(turned - k[:, None] * d) <= tolerance * scale)


@pytest.mark.parametrize("name", sorted(set(curvlib.surfaces()) - {"sphere"}))
def test_normal_turns_along_principal_directions(name, interior):
    s = curvlib.surface(name)
    u, v = interior(s, 200, seed=6, margin=0.05)
    assert_principal(s, u, v, 1e-5)


def test_directions_of_a_surface_of_revolution_are_meridians_and_parallels(interior):
    s = curvlib.surface("revolution")
    u, v = interior(s, 300, seed=7, margin=0.05)
    c, p = s.curvature(u, v), s.point(u, v)
    parallel = np.column_stack((-p[:, 1], p[:, 0], 0 * u)) / np.hypot(*p.T[:2])[:, None]
    along = np.stack([np.abs((d * parallel).sum(1)) for d in (c.d1, c.d2)])
    assert np.all(np.abs(along.max(0) - 1) < 1e-9)
    # Both occur: the parallel bends more at the outside, less at the waist.
    assert set(along.argmax(0)) == {0, 1}


def test_directions_at_the_poles_of_the_ellipsoid():
    """Axes 1.5, 1, 0.75: at the end of the shortest, k along x is c/a^2, along y c/b^2."""
    c = curvlib.surface("ellipsoid").curvature(np.linspace(0, 1, 9), [[0.0], [1.0]])
    np.testing.assert_allclose(np.abs(c.d1), np.broadcast_to([0, 1, 0], c.d1.shape), atol=1e-9)
    np.testing.assert_allclose(np.abs(c.d2), np.broadcast_to([1, 0, 0], c.d2.shape), atol=1e-9)


def test_umbilics_have_no_directions(everywhere):
    c = curvlib.surface("sphere").curvature(*everywhere)
    assert c.smooth.all()
    assert np.isnan(c.d1).all()
    assert np.isnan(c.d2).all()
