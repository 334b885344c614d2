"""Watanabe A, section 3.6: base Watanabe with tangent directions and the uniform normal."""

from curvlib.estimators.watanabe import between, by_trapezoids
from curvlib.kit.frame import Normal, canonical, kn, unit_normal

LABEL = "Watanabe A"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#009E73", "marker": "<", "linestyle": "--", "markerfacecolor": "white"}


def estimate(ring, normal: Normal = "uniform"):
    """K and H as in `watanabe`, with the angles phi_i between the tangent directions (3.23).

    Parameters
    ----------
    ring : Ring
        Batch of m closed one-rings of one valence n.
    normal : {"uniform", "area", "exact"}
        N_v: the mean of the facet normals (3.3), plain or weighted by area, or the mesh's own.

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
    kn_i (3.16) is the curvature of the circle through v and v_i that touches the tangent plane.
    Order: none proven. Measured as for `watanabe`.

    Source: Surazhsky et al. (2003), section 3.6.
    """
    N = unit_normal(ring, normal)
    return by_trapezoids(between(canonical(ring, N)), kn(ring, N))
