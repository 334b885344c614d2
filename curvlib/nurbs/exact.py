"""Exact curvature in compiled loops: evaluate the polynomials of a surface at many points.

Two nested Horner schemes; the choice of span makes values one-sided. Only + - * / and square roots
are used, which IEEE 754 rounds correctly: the same bytes on every machine.
"""

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.tensor import from_derivatives
from curvlib.kit.vectors import add, at, divide


@compiled
def side(breaks, closed, t, above):
    """The span on one side of a parameter, and the parameter in that span: beyond a seam, the
    other end of the domain."""
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
def curvatures(polynomials, closed, flat, u, v, above_u, above_v):
    """K, H, k1, k2 (4, m) and d1, d2, normal, S, each (m, 3), on the named sides of the points;
    all but S are NaN where the surface is singular. `flat` as in `kit.tensor`."""
    m = len(u)
    numbers = np.empty((4, m))
    d1, d2, normal, point = np.empty((m, 3)), np.empty((m, 3)), np.empty((m, 3)), np.empty((m, 3))
    for k in range(m):
        span_u, x = side(polynomials.breaks_u, closed[0], u[k], above_u)
        span_v, y = side(polynomials.breaks_v, closed[1], v[k], above_v)
        S, S_u, S_v, S_uu, S_uv, S_vv = derivatives(polynomials, span_u, x, span_v, y)
        c, n = from_derivatives(S_u, S_v, S_uu, S_uv, S_vv, flat)
        numbers[0, k], numbers[1, k], numbers[2, k], numbers[3, k] = c.K, c.H, c.k1, c.k2
        for j in range(3):
            d1[k, j], d2[k, j], normal[k, j], point[k, j] = c.d1[j], c.d2[j], n[j], S[j]
    return numbers, (d1, d2, normal, point)
