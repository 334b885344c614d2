"""Paraboloid fitting, section 3.1."""

import math

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.fit import CUTOFF, least_squares, regression
from curvlib.kit.frame import Normal, canonical, unit_normal, whitening
from curvlib.kit.vectors import at

LABEL = "Paraboloid fitting"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#D55E00", "marker": "o", "linestyle": "-"}


def estimate(ring, normal: Normal = "uniform"):
    """K = 4 a c - b^2 and H = a + c (3.5) of z = a x^2 + b x y + c y^2 (3.4), fitted by least
    squares to the one-ring in the canonical form (z is the depth below the tangent plane).

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
    A ring that may leave the form undetermined is whitened first: its coordinates are scaled by
    the ring's second moments, so that a long triangle is not taken for a missing direction.
    Singular values below CUTOFF times the largest are then cut off, and the form has the least
    Frobenius norm. The factor sqrt(2) at x y makes that norm independent of the frame.

    Order: O(h) on any ring that determines the form, with the exact normal (Cazals and Pouget
    2005, degree 2). Measured on shrinking regular rings: O(h^2) for H from valence 4 on and for K
    from 6 on. With a normal that is itself O(h) off, the error does not vanish on irregular rings.

    Source: Surazhsky et al. (2003), section 3.1.
    """
    xyz = canonical(ring, unit_normal(ring, normal))
    x, bounds = regression(_columns(xyz))
    K, H = _of_form(x)
    weak = ~(bounds > CUTOFF**2)
    if weak.any():
        K[weak], H[weak] = _whitened(xyz.compress(weak, 2))
    return K, H


@compiled
def _of_form(x):
    """K and H (m,) of the forms x (3, m): a, b / sqrt(2) and c."""
    m = x.shape[1]
    K, H = np.empty(m), np.empty(m)
    for k in range(m):
        a, xy, c = x[0, k], math.sqrt(2) * x[1, k], x[2, k]
        K[k], H[k] = 4 * a * c - xy * xy, a + c
    return K, H


@compiled
def _columns(xyz):
    """x^2, sqrt(2) x y, y^2 and z, (4, n, m)."""
    _, n, m = xyz.shape
    columns = np.empty((4, n, m))
    for i in range(n):
        for k in range(m):
            x, y, z = at(xyz, i, k)
            columns[0, i, k] = x * x
            columns[1, i, k] = math.sqrt(2) * x * y
            columns[2, i, k] = y * y
            columns[3, i, k] = z
    return columns


def _whitened(xyz):
    """K and H of the minimum-norm form in u = p x, v = q x + r y."""
    (x, y, z), (p, q, r) = xyz, whitening(xyz)
    a, b, c = least_squares(_columns(np.stack((p * x, q * x + r * y, z))), CUTOFF)
    xy, rr = math.sqrt(2) * b, p * r
    K = (4 * a * c - xy * xy) * (rr * rr)
    return K, a * p * p + xy * p * q + c * (q * q + r * r)
