"""Taubin A (constant integration), section 3.6: weights by angle instead of area."""

from typing import Literal

from curvlib.estimators.taubin import Principal, from_tensor
from curvlib.kit.frame import Normal, canonical, kn, unit_normal
from curvlib.kit.ring import alpha, with_preceding

LABEL = "Taubin A"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#CC79A7", "marker": "P", "linestyle": "--", "markerfacecolor": "white"}
ONE_SIDED = "w_i is the angle to the next neighbour; angles='centred' takes both sides"


def estimate(
    ring,
    angles: Literal["one-sided", "centred"] = "one-sided",
    normal: Normal = "uniform",
    principal: Principal = "corrected",
):
    """K and H as in `taubin`, with weights by angle: constant integration of (3.22).

    Parameters
    ----------
    ring : Ring
        Batch of m closed one-rings of one valence n.
    angles : {"one-sided", "centred"}
        w_i ~ angle(v_i, v, v_{i+1}), or ~ the sum of the angles on both sides of e_i.
    normal : {"uniform", "area", "exact"}
        N_v: the mean of the facet normals (3.3), plain or weighted by area, or the mesh's own.
    principal : {"corrected", "as-printed"}
        k2 = 3 m22 - m11, or k2 = k1 as (3.21) is printed.

    Returns
    -------
    K, H : ndarray, (m,)
        Pointwise, in 1/length^2 and 1/length, H > 0 where the surface bends away from its normal.
        NaN: needs a closed one-ring.

    Raises
    ------
    InputError
        normal="exact" and the mesh has no normals.

    Notes
    -----
    Order: none proven. Measured as for `taubin`.

    Source: Surazhsky et al. (2003), section 3.6.
    """
    N = unit_normal(ring, normal)
    weights = alpha(ring) if angles == "one-sided" else with_preceding(alpha(ring))
    return from_tensor(weights, kn(ring, N), canonical(ring, N), principal)
