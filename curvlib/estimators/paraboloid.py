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


@compiled
def estimate(ring, normal: Normal = "uniform"):
    """K and H by (3.5) of z = a x^2 + b x y + c y^2 (3.4), least squares over the one-ring.

    A ring that may leave the form undetermined is fitted in whitened coordinates, in which a long
    triangle does not pass for a missing direction: singular values below CUTOFF times the largest
    are cut off, and the form has the least Frobenius norm there. That does not depend on the
    frame: hence the factor sqrt(2) at x y.
    """
    xyz = canonical(ring, unit_normal(ring, normal))
    (a, b, c), weak = regression(_columns(xyz), CUTOFF)
    b = math.sqrt(2) * b
    K, H = 4 * a * c - b * b, a + c
    if len(weak) > 0:
        K[weak], H[weak] = _whitened(xyz[:, :, weak])
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


@compiled
def _whitened(xyz):
    """K and H of the form of least norm in u = p x, v = q x + r y; overwrites x and y."""
    p, q, r = whitening(xyz)
    xyz[1] = q * xyz[0] + r * xyz[1]
    xyz[0] *= p
    a, b, c = least_squares(_columns(xyz), CUTOFF)
    b = math.sqrt(2) * b
    return (4 * a * c - b * b) * (p * r) ** 2, a * p * p + b * p * q + c * (q * q + r * r)
