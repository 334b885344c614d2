"""Exact curvature at a pole, where an edge of the domain is one point of the surface.

S_u or S_v vanishes there, so that the formulas of regular points do not apply.
"""

import numpy as np

from curvlib.kit.fit import least_squares
from curvlib.kit.tensor import from_form

from . import exact
from .agreement import AGREE_NORMAL, flat, tolerance

MERIDIANS = 7  # per knot span: three determine the form, the others test it


def at_pole(net, polynomials, axis, end):
    """K, H, k1, k2 (4,) and d1, d2, normal (3, 3); NaN where the surface is not C^2 (not C^1).

    Every meridian passes through the pole, so each gives II(d, d) = S_vv . n in its own
    direction d = S_v; all of them together have to be one quadratic form.
    """
    breaks = polynomials[:2]
    steps = np.arange(1, MERIDIANS + 1) / (MERIDIANS + 1)
    spans = np.diff(breaks[1 - axis])[:, None]
    around = (breaks[1 - axis][:-1, None] + spans * steps).ravel()
    edge = np.full_like(around, breaks[axis][end])
    u, v = (edge, around) if axis == 0 else (around, edge)
    # `closed` is False, so that no span beyond the pole is taken where meridians close there.
    sides = [[exact.side(b, False, x, True) for x in t] for b, t in zip(breaks, (u, v))]
    S = [exact.derivatives(polynomials, *a, *b) for a, b in zip(*sides)]
    S = np.moveaxis(S, 0, 1)
    along, second = (S[1], S[3]) if axis == 0 else (S[2], S[5])
    # S_uv x S_v is outward where v leaves the pole, S_u x S_uv where u does.
    across = S[4] if (axis == 1) == (end == 0) else -S[4]

    numbers, vectors = np.full(4, np.nan), np.full((3, 3), np.nan)
    speed = np.sqrt(_dot(along, along))
    length = breaks[axis][-1] - breaks[axis][0]
    if not (speed * length > net.near).all():
        return numbers, vectors
    d = along / speed[:, None]
    n = np.cross(across, along).sum(0)
    with np.errstate(invalid="ignore"):
        n /= np.sqrt(_dot(n, n))
    if not np.abs(_dot(d, n)).max() <= AGREE_NORMAL:
        return numbers, vectors
    e1 = d[0] - n * _dot(n, d[0])
    e1 /= np.sqrt(_dot(e1, e1))
    x, y, kn = _dot(d, e1), _dot(d, np.cross(n, e1)), -_dot(second, n) / (speed * speed)
    columns = np.array([x * x, 2 * x * y, y * y, kn])
    form = least_squares(columns[:, :, None].copy(), 1e-6)[:, 0]
    residual = np.abs(form @ columns[:3] - kn).max()
    if residual <= tolerance(net) * max(np.abs(kn).max(), 1 / net.size):
        c = from_form(*form, tuple(e1), tuple(n), flat(net))
        numbers, vectors[:2] = np.array(c[:4]), (c.d1, c.d2)
        if np.abs(_dot(d, n)).max() * net.size <= net.near:
            _flatten(polynomials.coefficients, axis, end, n)
    vectors[2] = n
    return numbers, vectors


def _flatten(coefficients, axis, end, n):
    """Project the meridians' tangents onto the tangent plane of n: coordinates rounded by an angle
    of 1e-10 would give the surface a K of 1e-10 / r at a distance r from the pole."""
    first = coefficients[end, :, 1] if axis == 0 else coefficients[:, end, :, 1]
    tangents = first[..., :3]
    tangents -= (tangents @ n)[..., None] * n


def _dot(a, b):
    return (a * b).sum(-1)
