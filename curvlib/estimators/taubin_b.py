"""Taubin B (smoothing with a trapezoidal rule), section 3.6: kn averaged with its neighbour's."""

from typing import Literal

from curvlib.estimators.taubin import Principal, from_tensor
from curvlib.kit.compiled import compiled
from curvlib.kit.frame import Normal, canonical, kn, unit_normal
from curvlib.kit.ring import alpha, following, with_preceding

LABEL = "Taubin B"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#CC79A7", "marker": "X", "linestyle": ":", "markerfacecolor": "white"}
ONE_SIDED = "kn_i is averaged with that of the next neighbour"


@compiled
def estimate(
    ring,
    weights: Literal["area", "angle"] = "area",
    normal: Normal = "uniform",
    principal: Principal = "corrected",
):
    """(3.22) with (kn_i + kn_{i+1}) / 2 for kn_i, weighted as in Taubin or as in Taubin A."""
    N = unit_normal(ring, normal)
    w = with_preceding(ring.areas) if weights == "area" else alpha(ring)
    curvature = kn(ring, N)
    mean = following(curvature)
    for i in range(len(mean)):
        for k in range(mean.shape[1]):
            mean[i, k] = (curvature[i, k] + mean[i, k]) / 2
    return from_tensor(w, mean, canonical(ring, N), principal)
