"""The approach of Watanabe and Belyaev, section 3.4."""

import math
from typing import Literal

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.frame import Normal, canonical, kn, unit_normal
from curvlib.kit.ring import alpha, zeros

LABEL = "Watanabe-Belyaev"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#009E73", "marker": "^", "linestyle": "-"}


def estimate(
    ring,
    normal: Normal = "area",
    angles: Literal["spatial", "projected"] = "spatial",
):
    """H = sum w_i kn_i / (2 pi) (3.17) and K = 3 H^2 - sum w_i kn_i^2 / pi (3.18): the trapezoidal
    rule for the integrals (3.14), w_i = (phi_{i-1} + phi_i) / 2.

    Parameters
    ----------
    ring : Ring
        Batch of m closed one-rings of one valence n.
    normal : {"area", "uniform", "exact"}
        N_v: the mean of the facet normals (3.3), weighted by area or plain, or the mesh's own.
    angles : {"spatial", "projected"}
        phi_i = angle(v_i, v, v_{i+1}), in space, or between the tangent directions (3.23).

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

    Source: Surazhsky et al. (2003), section 3.4, after Watanabe and Belyaev (2001).
    """
    N = unit_normal(ring, normal)
    phi = alpha(ring) if angles == "spatial" else between(canonical(ring, N))
    return by_trapezoids(phi, kn(ring, N))


@compiled
def by_trapezoids(phi, curvature):
    """K and H (m,) of normal `curvature` (n, m), at angles `phi` (n, m) from one to the next."""
    n, m = phi.shape
    mean, mean_square = zeros(m), zeros(m)
    for i in range(n):
        for k in range(m):
            w = (phi[i - 1, k] + phi[i, k]) * curvature[i, k]
            mean[k] += w
            mean_square[k] += w * curvature[i, k]
    K, H = mean_square, mean
    for k in range(m):
        H[k] /= 4 * math.pi
        K[k] = 3 * H[k] * H[k] - K[k] / (2 * math.pi)
    return K, H


@compiled
def between(along):
    """Angle from T_i to T_{i+1} about the normal, in (-pi, pi]: they sum to 2 pi around v.

    `along`: vectors (x, y) along T_i, in a canonical form (3, n, m).
    """
    _, n, m = along.shape
    out = np.empty((n, m))
    for i in range(n):
        j = (i + 1) % n
        for k in range(m):
            x, y, x1, y1 = along[0, i, k], along[1, i, k], along[0, j, k], along[1, j, k]
            # In the canonical frame, seen along -N, the ring runs counter-clockwise about N.
            cosine, sine = x * x1 + y * y1, x * y1 - y * x1 + 0.0
            # arctan2(sine, cosine) in half its time. The + 0.0 above turns a sine of -0 into 0,
            # so that opposite directions are pi apart, never -pi.
            out[i, k] = math.copysign(math.pi / 2, sine) - math.atan(cosine / sine)
    return out
