"""Jittered meshes: exact values against closed forms of each surface, their triangles."""

import mpmath
import numpy as np
import pytest

from curvlib.meshes.jittered import JITTER, RADII, SEMI_AXES, SURFACES, graph, jittered, wavy

EVERY = [(surface, n) for surface in SURFACES for n in (12, 25)]


def parallel(a, b):
    return abs((a * b).sum(1))


def test_the_torus():
    """k1 = 1/r along the tube, k2 = cos(v) / (R + r cos(v)) about the axis."""
    m = jittered("torus", 12)
    R, r = RADII
    x, y, z = m.vertices.T
    around = np.hypot(x, y)
    np.testing.assert_allclose((around - R) ** 2 + z * z, r * r)
    np.testing.assert_allclose(m.k1, 1 / r)
    np.testing.assert_allclose(m.k2, (around - R) / r / around, atol=1e-14)
    about = np.stack((-y / around, x / around, 0 * z), 1)
    np.testing.assert_allclose(parallel(m.d2, about), 1)
    core = R * np.stack((x / around, y / around, 0 * z), 1)
    np.testing.assert_allclose(m.normals, (m.vertices - core) / r, atol=1e-14)


def test_the_ellipsoid():
    """With h = 1 / sqrt(x^2 / a^4 + y^2 / b^4 + z^2 / c^4) and (a, b, c) the semi-axes,
    K = h^4 / (a b c)^2 and H = h^3 (a^2 + b^2 + c^2 - |x|^2) / (2 (a b c)^2)."""
    m = jittered("ellipsoid", 12)
    x = m.vertices
    np.testing.assert_allclose(((x / SEMI_AXES) ** 2).sum(1), 1)
    h = 1 / np.sqrt((x * x / SEMI_AXES**4).sum(1))
    volume = np.prod(SEMI_AXES) ** 2
    np.testing.assert_allclose(m.K, h**4 / volume)
    np.testing.assert_allclose(m.H, h**3 * ((SEMI_AXES**2).sum() - (x * x).sum(1)) / (2 * volume))
    assert ((m.normals * x).sum(1) > 0).all()


def test_the_patch():
    """Against the textbook's formulas on derivatives by mpmath, of 40 digits."""
    m = jittered("patch", 12)
    np.testing.assert_allclose(m.vertices[:, 2], wavy(*m.vertices[:, :2].T))

    def f(x, y):
        return x * x / 2 - 3 * y * y / 10 + 3 * mpmath.sin(3 * x) * mpmath.cos(2 * y) / 20

    rows = np.flatnonzero(~m.boundary)[::17]
    with mpmath.workdps(40):
        for k in rows:
            at = tuple(map(mpmath.mpf, m.vertices[k, :2]))
            p, q, r, s, t = (
                mpmath.diff(f, at, n) for n in ((1, 0), (0, 1), (2, 0), (1, 1), (0, 2))
            )
            g = 1 + p * p + q * q
            H = -((1 + q * q) * r - 2 * p * q * s + (1 + p * p) * t) / (2 * g**1.5)
            assert m.K[k] == pytest.approx(float((r * t - s * s) / g**2), abs=1e-12)
            assert m.H[k] == pytest.approx(float(H), abs=1e-12)
            # S_u turned by the shape operator: II(d, .) = k I(d, .) for d = u S_u + v S_v.
            (u, v, _), root = m.d1[k], mpmath.sqrt(g)
            first = (1 + p * p) * u + p * q * v, p * q * u + (1 + q * q) * v
            second = -(r * u + s * v) / root, -(s * u + t * v) / root
            for a, b in zip(first, second):
                assert float(b - m.k1[k] * a) == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize(("surface", "n"), EVERY)
def test_values_agree_with_each_other(surface, n):
    m = jittered(surface, n)
    assert len(m.vertices) == n * n
    np.testing.assert_allclose(m.k1 * m.k2, m.K, atol=1e-12)
    np.testing.assert_allclose((m.k1 + m.k2) / 2, m.H, atol=1e-12)
    assert (m.k1 >= m.k2).all()
    np.testing.assert_allclose(np.cross(m.d1, m.d2), m.normals, atol=1e-12)


@pytest.mark.parametrize(("surface", "n"), EVERY)
def test_triangles_cover_the_surface_and_are_turned_outward(surface, n):
    m = jittered(surface, n)
    a, b, c = m.vertices[m.faces].swapaxes(0, 1)
    across = np.cross(b - a, c - a)
    assert (across * m.normals[m.faces].sum(1)).sum(1).min() > 0
    euler = len(m.vertices) - len(m.faces) / 2  # of a closed mesh
    if surface == "patch":
        assert m.boundary.sum() == 4 * (n - 1)
        assert len(m.faces) == 2 * (n - 1) ** 2
    else:
        assert not m.boundary.any()
        assert euler == {"torus": 0, "ellipsoid": 2}[surface]
    assert m.closed.sum() == (~m.boundary).sum()
    valences = {len(ring) for _, ring in m.rings}
    assert min(valences) <= 5 < 7 <= max(valences)


def test_seeds():
    one, other = (jittered("ellipsoid", 12, seed).vertices for seed in (0, 1))
    np.testing.assert_array_equal(one, jittered("ellipsoid", 12).vertices)
    moves = np.abs(one - other).max()
    assert 0 < moves < 4 * JITTER * np.sqrt(4 * np.pi) / 12


def test_the_patch_is_the_graph_of_the_tests_of_fits():
    np.testing.assert_array_equal(jittered("patch", 9, 3).vertices, graph(9, wavy, 3).vertices)
