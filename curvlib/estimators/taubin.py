"""Taubin's approach, section 3.5."""

import math
from typing import Literal

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.frame import Normal, canonical, kn, unit_normal
from curvlib.kit.ring import total, with_preceding, zeros

Principal = Literal["corrected", "as-printed"]

LABEL = "Taubin"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#CC79A7", "marker": "D", "linestyle": "-"}


def estimate(ring, normal: Normal = "uniform", principal: Principal = "corrected"):
    """K = k1 k2 and H = (k1 + k2) / 2 of the eigenvalues m11, m22 of M = sum w_i kn_i T_i T_i^t
    (3.22): k1 = 3 m11 - m22, k2 = 3 m22 - m11 (3.21); w_i ~ area of the two triangles at e_i.

    Parameters
    ----------
    ring : Ring
        Batch of m closed one-rings of one valence n.
    normal : {"uniform", "area", "exact"}
        N_v: the mean of the facet normals (3.3), plain or weighted by area, or the mesh's own.
    principal : {"corrected", "as-printed"}
        k2 = 3 m22 - m11, or k2 = k1 as (3.21) is printed.

    Returns
    -------
    K, H : ndarray, (m,)
        Pointwise, in 1/length^2 and 1/length, H > 0 where the surface bends away from its normal.
        NaN: needs a closed one-ring.

    Raises
    ------
    InputError
        normal="exact" and the mesh has no normals.

    Notes
    -----
    Order: none proven. Measured on shrinking regular rings: O(h^2) for H from valence 4 on and for
    K from 6 on; on irregular rings the error does not vanish, even with exact normals.

    Source: Surazhsky et al. (2003), section 3.5, after Taubin (1995).
    """
    N = unit_normal(ring, normal)
    weights = with_preceding(ring.areas)
    return from_tensor(weights, kn(ring, N), canonical(ring, N), principal)


@compiled
def from_tensor(weights, curvature, along, principal):
    """K and H (m,) of the tensor M of `estimate`.

    Parameters
    ----------
    weights, curvature : (n, m)
        w_i, normalised here, and kn_i.
    along : (3, n, m)
        A canonical form; its (x, y) is along T_i and normalised here.
    principal : str
        As in `estimate`.

    Notes
    -----
    With trace t and determinant d of M, k1 k2 = 16 d - 3 t^2 and (k1 + k2) / 2 = t.
    """
    n, m = weights.shape
    m11, m12, m22 = zeros(m), zeros(m), zeros(m)
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
