"""Taubin B (smoothing with a trapezoidal rule), section 3.6: kn averaged with its neighbour's."""

from typing import Literal

import numpy as np

from curvlib.estimators.taubin import Principal, from_tensor
from curvlib.kit.compiled import compiled
from curvlib.kit.frame import Normal, canonical, kn, unit_normal
from curvlib.kit.ring import alpha, with_preceding

LABEL = "Taubin B"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#CC79A7", "marker": "X", "linestyle": ":", "markerfacecolor": "white"}
ONE_SIDED = "kn_i is averaged with that of the next neighbour"


def estimate(
    ring,
    weights: Literal["area", "angle"] = "area",
    normal: Normal = "uniform",
    principal: Principal = "corrected",
):
    """K and H as in `taubin`, with (kn_i + kn_{i+1}) / 2 in place of kn_i in (3.22).

    Parameters
    ----------
    ring : Ring
        Batch of m closed one-rings of one valence n.
    weights : {"area", "angle"}
        w_i as in `taubin` or as in `taubin_a`.
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
    Order: none proven. Measured on shrinking regular rings from valence 4 on: O(h^2) for H; the
    error of K does not vanish, and on irregular rings neither does that of H.

    Source: Surazhsky et al. (2003), section 3.6.
    """
    N = unit_normal(ring, normal)
    w = with_preceding(ring.areas) if weights == "area" else alpha(ring)
    return from_tensor(w, _smoothed(kn(ring, N)), canonical(ring, N), principal)


@compiled
def _smoothed(x):
    """(x_i + x_{i+1}) / 2, (n, m)."""
    n, m = x.shape
    out = np.empty((n, m))
    for i in range(n):
        j = (i + 1) % n
        for k in range(m):
            out[i, k] = (x[i, k] + x[j, k]) / 2
    return out
