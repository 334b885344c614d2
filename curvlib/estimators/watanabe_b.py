"""Watanabe B, section 3.6: the extreme normal curvatures are the principal ones."""

from curvlib.ring import Normal

LABEL = "Watanabe B"
STYLE = {"color": "#009E73", "marker": ">", "linestyle": ":", "markerfacecolor": "white"}


def estimate(ring, normal: Normal = "uniform"):
    """K by (2.3) and H by (2.4) of the largest and the smallest kn_i (3.16)."""
    kn = ring.kn(normal)
    k1, k2 = kn.max(0), kn.min(0)
    return k1 * k2, (k1 + k2) / 2
