"""The approach of Watanabe and Belyaev, section 3.4."""

import math
from typing import Literal

import numpy as np

from curvlib.ring import Normal, following, preceding

LABEL = "Watanabe-Belyaev"
STYLE = {"color": "#009E73", "marker": "^", "linestyle": "-"}


def estimate(
    ring,
    normal: Normal = "area",
    angles: Literal["spatial", "projected"] = "spatial",
):
    """H by (3.17) and K by (3.18), the trapezoid rule for the integrals (3.14).

    phi_i = angle(v_i, v, v_{i+1}), in space or between the tangent directions (3.23), so that
    the weight of kn_i is (phi_{i-1} + phi_i) / 2.
    """
    kn = ring.kn(normal)
    phi = ring.alpha if angles == "spatial" else _between(ring.projected(normal))
    w = preceding(phi)
    w += phi
    w *= kn
    H = w.sum(0) / (4 * math.pi)
    K = 3 * H * H - np.einsum("nm,nm->m", w, kn) / (2 * math.pi)
    return K, H


def _between(along):
    """Angle from T_i to T_{i+1} about the normal, in (-pi, pi]: they sum to 2 pi around v.

    `along`: vectors along T_i, (2, n, m).
    """
    (x, y), (x1, y1) = along, following(along)
    # In the canonical frame, seen along -N, the ring runs counter-clockwise about N.
    cosine, sine = x * x1 + y * y1, x * y1 - y * x1 + 0.0
    # arctan2(sine, cosine), in half its time; pi where sine is a zero, of which no sign is left.
    return np.copysign(math.pi / 2, sine) - np.arctan(cosine / sine)
