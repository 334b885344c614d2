"""Exact curvature against fifty digits, by Cox and de Boor's recursion."""

import mpmath
import numpy as np
import pytest

import curvlib


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
def test_fifty_digits_agree(name, interior):
    s = curvlib.surface(name)
    for u, v in zip(*interior(s, 6, seed=5, margin=0.01)):
        with mpmath.workdps(50):
            K, H = map(float, mp_curvature(s.model, u, v))
        exact = s.curvature(u, v)
        k = max(abs(exact.k1), abs(exact.k2))
        assert abs(exact.K - K) <= 1e-12 * k * k
        assert abs(exact.H - H) <= 1e-12 * k
        assert (exact.K, exact.H) == pytest.approx((K, H), rel=1e-10)
