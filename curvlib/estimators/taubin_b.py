"""Taubin B (smoothing with a trapezoidal rule), section 3.6: kn averaged with its neighbour's."""

from typing import Literal

from curvlib.estimators import taubin
from curvlib.ring import Normal, following

LABEL = "Taubin B"
STYLE = {"color": "#CC79A7", "marker": "X", "linestyle": ":", "markerfacecolor": "white"}
ONE_SIDED = "kn_i is averaged with that of the next neighbour"


def estimate(
    ring,
    weights: Literal["area", "angle"] = "area",
    normal: Normal = "uniform",
    principal: taubin.Principal = "corrected",
):
    """(3.22) with (kn_i + kn_{i+1}) / 2 for kn_i, weighted as in Taubin or as in Taubin A."""
    kn = ring.kn(normal)
    w = taubin.edge_areas(ring) if weights == "area" else ring.alpha
    return taubin.from_tensor(w, (kn + following(kn)) / 2, ring.projected(normal), principal)
