"""Taubin A (constant integration), section 3.6: weights by angle instead of area."""

from typing import Literal

from curvlib.estimators import taubin
from curvlib.ring import Normal, preceding

LABEL = "Taubin A"
STYLE = {"color": "#CC79A7", "marker": "P", "linestyle": "--", "markerfacecolor": "white"}
ONE_SIDED = "w_i is the angle to the next neighbour; angles='centred' takes both sides"


def estimate(
    ring,
    angles: Literal["one-sided", "centred"] = "one-sided",
    normal: Normal = "uniform",
    principal: taubin.Principal = "corrected",
):
    """(3.22) with w_i ~ angle(v_i, v, v_{i+1}), or ~ the angles on both sides of e_i."""
    w = ring.alpha if angles == "one-sided" else preceding(ring.alpha) + ring.alpha
    return taubin.from_tensor(w, ring.kn(normal), ring.projected(normal), principal)
