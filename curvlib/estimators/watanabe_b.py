"""Watanabe B, section 3.6: the extreme normal curvatures are the principal ones."""

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.frame import Normal, kn, unit_normal

LABEL = "Watanabe B"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#009E73", "marker": ">", "linestyle": ":", "markerfacecolor": "white"}


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
    return _of_extremes(kn(ring, unit_normal(ring, normal)))


@compiled
def _of_extremes(curvature):
    """K and H (m,) of the largest and the smallest of the normal `curvature` (n, m)."""
    n, m = curvature.shape
    K, H = np.empty(m), np.empty(m)
    for k in range(m):
        K[k], H[k] = curvature[0, k], curvature[0, k]
    for i in range(1, n):
        for k in range(m):
            x = curvature[i, k]
            K[k] = x if x > K[k] else K[k]
            H[k] = x if x < H[k] else H[k]
    for k in range(m):
        K[k], H[k] = K[k] * H[k], (K[k] + H[k]) / 2
    return K, H
