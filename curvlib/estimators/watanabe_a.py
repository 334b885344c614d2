"""Watanabe A, section 3.6: base Watanabe with tangent directions and the uniform normal."""

from curvlib.estimators.watanabe import between, by_trapezoids
from curvlib.kit.compiled import compiled
from curvlib.kit.frame import Normal, canonical, kn, unit_normal

LABEL = "Watanabe A"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#009E73", "marker": "<", "linestyle": "--", "markerfacecolor": "white"}


@compiled
def estimate(ring, normal: Normal = "uniform"):
    """(3.17) and (3.18) with the angles between the tangent directions (3.23).

    The curvature of the circle through v and v_i that touches the tangent plane is (3.16).
    """
    N = unit_normal(ring, normal)
    return by_trapezoids(between(canonical(ring, N)), kn(ring, N))
