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
    K, H = np.empty(len(a)), np.empty(len(a))
    for k in range(len(a)):
        xy = math.sqrt(2) * b[k]
        K[k], H[k] = 4 * a[k] * c[k] - xy * xy, a[k] + c[k]
    if len(weak) > 0:
        some = np.empty((3, xyz.shape[1], len(weak)))
        for axis in range(3):
            for i in range(xyz.shape[1]):
                for k in range(len(weak)):
                    some[axis, i, k] = xyz[axis, i, weak[k]]
        a, c = _whitened(some)
        for k in range(len(weak)):
            K[weak[k]], H[weak[k]] = a[k], c[k]
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
    for i in range(xyz.shape[1]):
        for k in range(xyz.shape[2]):
            xyz[1, i, k] = q[k] * xyz[0, i, k] + r[k] * xyz[1, i, k]
            xyz[0, i, k] *= p[k]
    a, b, c = least_squares(_columns(xyz), CUTOFF)
    K, H = np.empty_like(p), np.empty_like(p)
    for k in range(len(p)):
        xy, rr = math.sqrt(2) * b[k], p[k] * r[k]
        K[k] = (4 * a[k] * c[k] - xy * xy) * (rr * rr)
        H[k] = a[k] * p[k] * p[k] + xy * p[k] * q[k] + c[k] * (q[k] * q[k] + r[k] * r[k])
    return K, H
