"""The approach of Watanabe and Belyaev, section 3.4."""

import math
from typing import Literal

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.frame import Normal, canonical, kn, unit_normal
from curvlib.kit.ring import alpha

LABEL = "Watanabe-Belyaev"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#009E73", "marker": "^", "linestyle": "-"}


@compiled
def estimate(
    ring,
    normal: Normal = "area",
    angles: Literal["spatial", "projected"] = "spatial",
):
    """H by (3.17) and K by (3.18), the trapezoid rule for the integrals (3.14).

    phi_i = angle(v_i, v, v_{i+1}), in space or between the tangent directions (3.23), so that
    the weight of kn_i is (phi_{i-1} + phi_i) / 2.
    """
    N = unit_normal(ring, normal)
    phi = alpha(ring) if angles == "spatial" else between(canonical(ring, N))
    return by_trapezoids(phi, kn(ring, N))


@compiled
def by_trapezoids(phi, curvature):
    """K and H of curvatures in directions that are angles phi (n, m) apart."""
    n, m = phi.shape
    mean, mean_square = np.zeros(m), np.zeros(m)
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
            # arctan2(sine, cosine), in half its time; pi where sine is a zero, of which no sign
            # is left.
            out[i, k] = math.copysign(math.pi / 2, sine) - math.atan(cosine / sine)
    return out
