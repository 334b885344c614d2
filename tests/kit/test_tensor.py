"""Curvatures from a form, a parametrisation, a graph, K and H: closed forms and invariances."""

import numpy as np
import pytest

from curvlib.kit import tensor

RNG = np.random.default_rng(5)
Z = (0.0, 0.0, 1.0)


def frame(rng):
    """A random right-handed orthonormal frame."""
    q, _ = np.linalg.qr(rng.standard_normal((3, 3)))
    return q if np.linalg.det(q) > 0 else -q


def holds(point, scale=1.0):
    """What is true of all Curvatures."""
    assert point.k1 >= point.k2
    assert point.k1 * point.k2 == pytest.approx(point.K, abs=1e-13 * scale * scale)
    assert point.k1 + point.k2 == pytest.approx(2 * point.H, abs=1e-13 * scale)


@pytest.mark.parametrize("draw", range(20))
def test_a_form_has_the_eigenvalues_of_its_matrix(draw):
    rng = np.random.default_rng(draw)
    a, b, c = rng.uniform(-1, 1, 3)
    e1, e2, n = frame(rng).T
    point = tensor.from_form(a, b, c, tuple(e1), tuple(n))
    holds(point)
    low, high = np.linalg.eigvalsh([[a, b], [b, c]])
    assert (point.k2, point.k1) == pytest.approx((low, high), abs=1e-14)
    form = a * np.outer(e1, e1) + b * (np.outer(e1, e2) + np.outer(e2, e1)) + c * np.outer(e2, e2)
    d1, d2 = np.array(point.d1), np.array(point.d2)
    assert form @ d1 == pytest.approx(high * d1, abs=1e-14)
    assert np.cross(d1, d2) == pytest.approx(n, abs=1e-14)


def test_an_umbilic_has_no_directions():
    assert np.isnan(tensor.from_form(0.5, 0.0, 0.5, (1.0, 0.0, 0.0), Z).d1).all()
    assert np.isnan(tensor.from_form(0.0, 0.0, 0.0, (1.0, 0.0, 0.0), Z).d1).all()
    nearly = tensor.from_form(1e-12, 0.0, 0.0, (1.0, 0.0, 0.0), Z, 1.0)
    assert np.isnan(nearly.d1).all(), "flat beside a curvature of 1"


@pytest.mark.parametrize("draw", range(20))
def test_a_parametrisation_of_a_torus(draw):
    """Radii R and r, outward normal: k = 1/r and cos v / (R + r cos v)."""
    rng = np.random.default_rng(draw)
    (u, v), R, r = rng.uniform(0, 2 * np.pi, 2), 2.0, 0.7
    turn = frame(rng)
    cu, su, cv, sv = np.cos(u), np.sin(u), np.cos(v), np.sin(v)
    w = R + r * cv
    derivatives = (
        (-w * su, w * cu, 0),
        (-r * sv * cu, -r * sv * su, r * cv),
        (-w * cu, -w * su, 0),
        (r * sv * su, -r * sv * cu, 0),
        (-r * cv * cu, -r * cv * su, -r * sv),
    )
    point, n = tensor.from_derivatives(*(tuple(turn @ d) for d in derivatives))
    holds(point, 2)
    assert (point.k1, point.k2) == pytest.approx((1 / r, cv / w), rel=1e-12)
    assert n == pytest.approx(turn @ (cu * cv, su * cv, sv), abs=1e-13)
    assert abs(np.dot(point.d2, turn @ (-su, cu, 0))) == pytest.approx(1)


def test_a_degenerate_parametrisation_is_nan():
    with np.errstate(all="ignore"):
        point, n = tensor.from_derivatives((1.0, 0.0, 0.0), (2.0, 0.0, 0.0), Z, Z, Z)
    assert np.isnan([*point[:4], *n]).all()


@pytest.mark.parametrize("draw", range(20))
def test_a_graph_agrees_with_the_textbook(draw):
    """Monge patch: K = (rt - s^2) / g^2, H = -((1+q^2) r - 2pqs + (1+p^2) t) / (2 g^1.5)."""
    rng = np.random.default_rng(draw)
    p, q, r, s, t = rng.uniform(-1, 1, 5)
    point, n = tensor.from_graph(p, q, r, s, t, *map(tuple, frame(rng).T))
    g = 1 + p * p + q * q
    H = -((1 + q * q) * r - 2 * p * q * s + (1 + p * p) * t) / (2 * g**1.5)
    holds(point)
    assert (point.K, point.H) == pytest.approx(((r * t - s * s) / g**2, H), abs=1e-13)
    assert np.dot(n, point.d1) == pytest.approx(0, abs=1e-13)


def test_a_batch_is_its_points():
    points = [tensor.from_form(*RNG.uniform(-1, 1, 3), (1.0, 0.0, 0.0), Z) for _ in range(4)]
    batch = tensor.batch(4)
    for k, point in enumerate(points):
        tensor.put(batch, k, point)
    for name, values in batch._asdict().items():
        np.testing.assert_array_equal(values.T, [getattr(point, name) for point in points])


def test_principal_values_of_K_and_H():
    k1, k2 = RNG.uniform(-1, 1, (2, 1000))
    k2[:10], k1[10:20], k2[20:30] = k1[:10], 0, 1e-12 * k1[20:30]
    high = np.maximum(k1, k2)
    found = tensor.principal_values(k1 * k2, (k1 + k2) / 2)
    assert found[0] == pytest.approx(high, rel=1e-6, abs=1e-8)
    assert (found[0] >= found[1]).all()
    np.testing.assert_allclose(found[0] * found[1], k1 * k2, rtol=1e-14, atol=1e-300)
    # The small root is the product over the large one: no digit is lost.
    assert found[0][20:30] * found[1][20:30] == pytest.approx((k1 * k2)[20:30], rel=1e-14)
    assert np.isnan(tensor.principal_values(1.0, 0.5)).all(), "no surface has H^2 < K"
    np.testing.assert_array_equal(tensor.principal_values(0.0, 0.0), (0, 0))
    assert np.isnan(tensor.principal_values(np.nan, 1.0)).all()
