"""Vectors as component-first arrays (3, ...): plain sums of products, the same bytes everywhere."""

import numpy as np


def dot(a, b):
    """a . b, shape (...)."""
    out = a[0] * b[0]
    for k in (1, 2):
        out += a[k] * b[k]
    return out


def norm(a):
    """|a|, shape (...)."""
    return np.sqrt(dot(a, a))


def cross(a, b, out=None):
    """a x b, shape (3, ...)."""
    out = np.empty(np.broadcast_shapes(a.shape, b.shape)) if out is None else out
    for k, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
        np.multiply(a[i], b[j], out=out[k, ...])
        out[k, ...] -= a[j] * b[i]
    return out


def angle(x, y):
    """Angle of (x, y) from the x axis in (-pi, pi]: arctan2(y, x) in half its time, but NaN at
    the origin and pi where y = -0.0."""
    out = np.arctan(y / x)
    behind = np.flatnonzero(np.signbit(x))
    out.ravel()[behind] += np.copysign(np.pi, y.take(behind) + 0.0)
    return out
