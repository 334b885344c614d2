"""Taubin A (constant integration), section 3.6: weights by angle instead of area."""

from typing import Literal

from curvlib.estimators.taubin import Principal, from_tensor
from curvlib.kit.compiled import compiled
from curvlib.kit.frame import Normal, canonical, kn, unit_normal
from curvlib.kit.ring import alpha, with_preceding

LABEL = "Taubin A"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#CC79A7", "marker": "P", "linestyle": "--", "markerfacecolor": "white"}
ONE_SIDED = "w_i is the angle to the next neighbour; angles='centred' takes both sides"


@compiled
def estimate(
    ring,
    angles: Literal["one-sided", "centred"] = "one-sided",
    normal: Normal = "uniform",
    principal: Principal = "corrected",
):
    """(3.22) with w_i ~ angle(v_i, v, v_{i+1}), or ~ the angles on both sides of e_i."""
    N = unit_normal(ring, normal)
    weights = alpha(ring) if angles == "one-sided" else with_preceding(alpha(ring))
    return from_tensor(weights, kn(ring, N), canonical(ring, N), principal)
