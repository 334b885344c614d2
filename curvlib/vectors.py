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
    return np.stack(
        (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    )
