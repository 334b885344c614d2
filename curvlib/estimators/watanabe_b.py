"""Watanabe B, section 3.6: the extreme normal curvatures are the principal ones."""

from curvlib.kit.compiled import compiled
from curvlib.kit.frame import Normal, kn, unit_normal

LABEL = "Watanabe B"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#009E73", "marker": ">", "linestyle": ":", "markerfacecolor": "white"}


@compiled
def estimate(ring, normal: Normal = "uniform"):
    """K by (2.3) and H by (2.4) of the largest and the smallest kn_i (3.16)."""
    curvature = kn(ring, unit_normal(ring, normal))
    k1, k2 = curvature[0].copy(), curvature[0].copy()
    for i in range(1, len(curvature)):
        for k in range(len(k1)):
            k1[k], k2[k] = max(k1[k], curvature[i, k]), min(k2[k], curvature[i, k])
    for k in range(len(k1)):
        k1[k], k2[k] = k1[k] * k2[k], (k1[k] + k2[k]) / 2
    return k1, k2
