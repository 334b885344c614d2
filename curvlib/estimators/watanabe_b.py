"""Watanabe B, section 3.6: the extreme normal curvatures are the principal ones."""

from curvlib.kit.compiled import compiled
from curvlib.kit.frame import Normal, kn, unit_normal

LABEL = "Watanabe B"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#009E73", "marker": ">", "linestyle": ":", "markerfacecolor": "white"}


@compiled
def estimate(ring, normal: Normal = "uniform"):
    """K = k1 k2 (2.3) and H = (k1 + k2) / 2 (2.4) of the largest and the smallest kn_i (3.16).

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
    Order: none; the error of K vanishes only where edges point along both principal directions.

    Source: Surazhsky et al. (2003), section 3.6.
    """
    curvature = kn(ring, unit_normal(ring, normal))
    k1, k2 = curvature[0].copy(), curvature[0].copy()
    for i in range(1, len(curvature)):
        for k in range(len(k1)):
            k1[k], k2[k] = max(k1[k], curvature[i, k]), min(k2[k], curvature[i, k])
    for k in range(len(k1)):
        k1[k], k2[k] = k1[k] * k2[k], (k1[k] + k2[k]) / 2
    return k1, k2
