"""Exact curvature in compiled loops: the polynomials of a surface at many points.

Two nested Horner schemes, one-sided by the choice of span, and + - * / and square roots alone:
the same bytes on every machine.
"""

import math

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.vectors import add, at, cross, divide, dot, norm

# Principal curvatures are the same where they agree to this, relative to the larger one.
UMBILIC = 1e-9


@compiled
def side(breaks, closed, t, above):
    """The span on one side of a parameter, and the parameter there: across a seam it is that of
    the other end of the domain."""
    last, span = len(breaks) - 2, -1
    while span <= last and (breaks[span + 1] < t or (above and breaks[span + 1] == t)):
        span += 1
    if span < 0:
        return (last, breaks[-1]) if closed else (0, t)
    if span > last:
        return (0, breaks[0]) if closed else (last, t)
    return span, t


@compiled
def derivatives(polynomials, span_u, u, span_v, v):
    """S, S_u, S_v, S_uu, S_uv, S_vv of the named spans."""
    coefficients = polynomials.coefficients[span_u, span_v]
    x, y = u - polynomials.centres_u[span_u], v - polynomials.centres_v[span_v]
    A = A_u = A_v = A_uu = A_uv = A_vv = (0.0, 0.0, 0.0, 0.0)
    for i in range(len(coefficients) - 1, -1, -1):
        f = f_v = f_vv = (0.0, 0.0, 0.0, 0.0)
        for j in range(coefficients.shape[1] - 1, -1, -1):
            f_vv, f_v, f = (
                _horner(f_vv, y, f_v),
                _horner(f_v, y, f),
                _horner(f, y, coefficients[i, j]),
            )
        A_uu, A_u, A = _horner(A_uu, x, A_u), _horner(A_u, x, A), _horner(A, x, f)
        A_uv, A_v = _horner(A_uv, x, A_v), _horner(A_v, x, f_v)
        A_vv = _horner(A_vv, x, f_vv)
    # The product rule on A = w S, solved for the derivatives of S; A_uu and A_vv are halves.
    w, w_u, w_v, w_uu, w_uv, w_vv = A[3], A_u[3], A_v[3], A_uu[3], A_uv[3], A_vv[3]
    S = divide(A, w)
    S_u = divide(add(A_u, -w_u, S), w)
    S_v = divide(add(A_v, -w_v, S), w)
    S_uu = divide(add(add(A_uu, -w_u, S_u), -w_uu, S), w / 2)
    S_vv = divide(add(add(A_vv, -w_v, S_v), -w_vv, S), w / 2)
    S_uv = divide(add(add(add(A_uv, -w_u, S_v), -w_v, S_u), -w_uv, S), w)
    S = add(S, 1, at(polynomials.origins.T, span_v, span_u))
    return S, S_u, S_v, S_uu, S_uv, S_vv


@compiled
def _horner(p, x, q):
    """p x + q."""
    return p[0] * x + q[0], p[1] * x + q[1], p[2] * x + q[2], p[3] * x + q[3]


@compiled
def points(polynomials, closed, u, v):
    """S, (m, 3)."""
    out = np.empty((len(u), 3))
    for k in range(len(u)):
        span_u, x = side(polynomials.breaks_u, closed[0], u[k], True)
        span_v, y = side(polynomials.breaks_v, closed[1], v[k], True)
        # Only S is used; the compiler drops the rest.
        S = derivatives(polynomials, span_u, x, span_v, y)[0]
        out[k, 0], out[k, 1], out[k, 2] = S
    return out


@compiled
def curvatures(polynomials, closed, size, umbilic, u, v, above_u, above_v):
    """K, H, k1 and k2, (4, m), and d1, d2, the normal and S, each (m, 3), on the named sides of
    the points; NaN, but for S, where the surface is singular there.

    The second fundamental form is taken in the orthonormal frame of S_u / |S_u| and
    n x S_u / |S_u|: there k1 - k2 is a length, exact also where k1 = k2.
    """
    m = len(u)
    numbers = np.empty((4, m))
    d1, d2, normal, point = np.empty((m, 3)), np.empty((m, 3)), np.empty((m, 3)), np.empty((m, 3))
    for k in range(m):
        span_u, x = side(polynomials.breaks_u, closed[0], u[k], above_u)
        span_v, y = side(polynomials.breaks_v, closed[1], v[k], above_v)
        S, S_u, S_v, S_uu, S_uv, S_vv = derivatives(polynomials, span_u, x, span_v, y)
        n = cross(S_u, S_v)
        area, p = norm(n), norm(S_u)
        n = divide(n, area if area > 1e-13 * p * norm(S_v) else math.nan)
        q, r = dot(S_u, S_v) / p, area / p
        L, M, N = -dot(S_uu, n), -dot(S_uv, n), -dot(S_vv, n)
        a = L / (p * p)
        b = (M / p - q * a) / r
        c = (N - q * q * a - 2 * q * r * b) / (r * r)
        values, directions = principal(a, b, c, divide(S_u, p), n, size, umbilic)
        for i in range(4):
            numbers[i, k] = values[i]
        for j in range(3):
            d1[k, j], d2[k, j], normal[k, j] = directions[0][j], directions[1][j], directions[2][j]
            point[k, j] = S[j]
    return numbers, (d1, d2, normal, point)


@compiled
def principal(a, b, c, e1, n, size, umbilic=UMBILIC):
    """(K, H, k1, k2) and (d1, d2, n) of the form [[a, b], [b, c]] in the frame of e1 and n x e1;
    `size` is that of the surface, `umbilic` the relative gap below which k1 and k2 are the same."""
    H, half = (a + c) / 2, (a - c) / 2
    gap = math.sqrt(half * half + b * b)
    k1, k2 = H + gap, H - gap
    # (half + gap, b) and (b, gap - half) both point along k1; of two the longer does not cancel.
    x, y = (b, gap - half) if half < 0 else (half + gap, b)
    length = math.sqrt(x * x + y * y)
    if not gap > umbilic * max(abs(k1), abs(k2), 1 / size):
        length = math.nan
    e2 = cross(n, e1)
    d1 = divide((x * e1[0] + y * e2[0], x * e1[1] + y * e2[1], x * e1[2] + y * e2[2]), length)
    return (a * c - b * b, H, k1, k2), (d1, cross(n, d1), n)
