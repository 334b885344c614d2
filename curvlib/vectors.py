"""Vectors as component-first arrays (3, ...): plain sums of products, the same bytes everywhere."""

import numpy as np


def dot(a, b):
    """a . b, shape (...)."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def norm(a):
    """|a|, shape (...)."""
    return np.sqrt(dot(a, a))


def cross(a, b):
    """a x b, shape (3, ...)."""
    out = np.empty(np.broadcast_shapes(a.shape, b.shape))
    for k, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
        np.subtract(a[i] * b[j], a[j] * b[i], out=out[k, ...])
    return out
