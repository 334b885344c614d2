"""Taubin's approach, section 3.5."""

from typing import Literal

import numpy as np

from curvlib.ring import Normal, preceding

Principal = Literal["corrected", "as-printed"]

LABEL = "Taubin"
STYLE = {"color": "#CC79A7", "marker": "D", "linestyle": "-"}


def estimate(ring, normal: Normal = "uniform", principal: Principal = "corrected"):
    """K and H of M = sum w_i kn_i T_i T_i^t (3.22), w_i by the area of the triangles at e_i."""
    return from_tensor(edge_areas(ring), ring.kn(normal), ring.projected(normal), principal)


def edge_areas(ring):
    """Area of the two triangles that share e_i, (n, m)."""
    return preceding(ring.areas) + ring.areas


def from_tensor(weights, kn, along, principal: Principal):
    """K and H by (3.21) with k1 = 3 m11 - m22 and k2 = 3 m22 - m11; "as-printed": k2 = k1.

    The weights (n, m) and the vectors (2, n, m) along T_i are normalised here. With trace t and
    determinant d of M, whose eigenvalues are m11 and m22, k1 k2 = 16 d - 3 t^2 and
    (k1 + k2) / 2 = t.
    """
    xx, xy, yy = along[0] * along[0], along[0] * along[1], along[1] * along[1]
    w = weights * kn / (xx + yy)
    total = weights.sum(0)
    m11, m12, m22 = (np.einsum("nm,nm->m", w, tt) / total for tt in (xx, xy, yy))
    t, d = m11 + m22, m11 * m22 - m12 * m12
    if principal == "as-printed":
        k1 = t + 2 * np.hypot(m11 - m22, 2 * m12)
        return k1 * k1, k1
    return 16 * d - 3 * t * t, t
