"""Exact curvature at points of a surface: the values and their conventions."""

from typing import NamedTuple

import numpy as np


class Curvature(NamedTuple):
    """Exact curvature at points of a surface, pointwise.

    H > 0 where the surface bends away from its normal: the unit sphere with its normal outward
    has K = H = 1. On knot lines and seams the values of all sides have to agree, at a pole those
    of all meridians; where they do not, all but `normal` and `point` are NaN.

    Attributes
    ----------
    K : ndarray, shape (...)
        Gaussian curvature k1 k2, in 1 / length^2.
    H : ndarray, shape (...)
        Mean curvature (k1 + k2) / 2, in 1 / length.
    k1, k2 : ndarray, shape (...)
        Principal curvatures, k1 >= k2, in 1 / length.
    d1, d2 : ndarray, shape (..., 3)
        Unit directions of k1 and k2, right-handed with `normal`; d1 and -d1 are the same
        direction. NaN at umbilics, where k1 = k2 to rounding.
    smooth : ndarray of bool, shape (...)
        Whether the surface is C^2 there.
    normal : ndarray, shape (..., 3)
        Unit normal, along S_u x S_v; NaN where the normals of the sides differ.
    point : ndarray, shape (..., 3)
        S(u, v), in the unit of the control points.
    """

    K: np.ndarray
    H: np.ndarray
    k1: np.ndarray
    k2: np.ndarray
    d1: np.ndarray
    d2: np.ndarray
    smooth: np.ndarray
    normal: np.ndarray
    point: np.ndarray
