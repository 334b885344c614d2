"""Watanabe B, section 3.6: the extreme normal curvatures are the principal ones."""

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.ring import Normal, kn, unit_normal

LABEL = "Watanabe B"
STYLE = {"color": "#009E73", "marker": ">", "linestyle": ":", "markerfacecolor": "white"}


@compiled
def estimate(ring, normal: Normal = "uniform"):
    """K by (2.3) and H by (2.4) of the largest and the smallest kn_i (3.16)."""
    curvature = kn(ring, unit_normal(ring, normal))
    k1, k2 = curvature[0].copy(), curvature[0].copy()
    for i in range(1, len(curvature)):
        k1, k2 = np.maximum(k1, curvature[i]), np.minimum(k2, curvature[i])
    return k1 * k2, (k1 + k2) / 2
