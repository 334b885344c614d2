"""Taubin's approach, section 3.5."""

import math
from typing import Literal

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.frame import Normal, canonical, kn, unit_normal
from curvlib.kit.ring import total, with_preceding

Principal = Literal["corrected", "as-printed"]

LABEL = "Taubin"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#CC79A7", "marker": "D", "linestyle": "-"}


@compiled
def estimate(ring, normal: Normal = "uniform", principal: Principal = "corrected"):
    """K and H of M = sum w_i kn_i T_i T_i^t (3.22), w_i by the area of the triangles at e_i."""
    N = unit_normal(ring, normal)
    weights = with_preceding(ring.areas)
    return from_tensor(weights, kn(ring, N), canonical(ring, N), principal)


@compiled
def from_tensor(weights, curvature, along, principal):
    """K and H by (3.21) with k1 = 3 m11 - m22 and k2 = 3 m22 - m11; "as-printed": k2 = k1.

    The weights (n, m) of the curvatures (n, m) and the vectors (x, y) along T_i, in a canonical
    form (3, n, m), are normalised here. With trace t and determinant d of M, whose eigenvalues
    are m11 and m22, k1 k2 = 16 d - 3 t^2 and (k1 + k2) / 2 = t.
    """
    n, m = weights.shape
    m11, m12, m22 = np.zeros(m), np.zeros(m), np.zeros(m)
    for i in range(n):
        for k in range(m):
            x, y = along[0, i, k], along[1, i, k]
            w = weights[i, k] * curvature[i, k] / (x * x + y * y)
            m11[k] += w * (x * x)
            m12[k] += w * (x * y)
            m22[k] += w * (y * y)
    sums, as_printed = total(weights), principal == "as-printed"
    K, H = np.empty(m), np.empty(m)
    for k in range(m):
        a, b, c = m11[k] / sums[k], m12[k] / sums[k], m22[k] / sums[k]
        t, d = a + c, a * c - b * b
        if as_printed:
            k1 = t + 2 * math.hypot(a - c, 2 * b)
            K[k], H[k] = k1 * k1, k1
        else:
            K[k], H[k] = 16 * d - 3 * t * t, t
    return K, H
