"""Vectors as triples of numbers, in compiled loops.

Here `a` and `b` are tuples of 3 floats, `x` is a float; `add` is the axpy of BLAS.
"""

import math

import numpy as np

from .compiled import compiled


@compiled
def at(a, *index):
    """Gather the vector at an index of a component-first array `a` (3, ...)."""
    return a[(0, *index)], a[(1, *index)], a[(2, *index)]


@compiled
def add(a, x, b):
    """a + x b."""
    return a[0] + x * b[0], a[1] + x * b[1], a[2] + x * b[2]


@compiled
def times(a, x):
    """x a."""
    return a[0] * x, a[1] * x, a[2] * x


@compiled
def divide(a, x):
    """a / x, by one division and three products."""
    inverse = 1 / x
    return a[0] * inverse, a[1] * inverse, a[2] * inverse


@compiled
def dot(a, b):
    """a . b."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@compiled
def norm(a):
    """|a|."""
    # np.sqrt returns a NumPy float also without Numba, and dividing by a zero one is no error.
    return np.sqrt(dot(a, a))


@compiled
def cross(a, b):
    """a x b."""
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


@compiled
def tangents(a):
    """Unit vectors X and Y that make (X, Y, a) a right-handed orthonormal frame, `a` being unit.

    Source: Duff et al. (2017), Building an orthonormal basis, revisited (JCGT 6, 1).
    """
    sign = math.copysign(1.0, a[2])
    x = -1 / (sign + a[2])
    y = a[0] * a[1] * x
    X = 1 + sign * a[0] * a[0] * x, sign * y, -sign * a[0]
    return X, (y, sign + a[1] * a[1] * x, -a[1])
