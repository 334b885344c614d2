"""Paraboloid fitting, section 3.1."""

import math

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.fit import least_squares
from curvlib.kit.ring import Normal, canonical, unit_normal
from curvlib.kit.vectors import at

LABEL = "Paraboloid fitting"
STYLE = {"color": "#D55E00", "marker": "o", "linestyle": "-"}


@compiled
def estimate(ring, normal: Normal = "uniform"):
    """K and H by (3.5) of z = a x^2 + b x y + c y^2 (3.4), least squares over the one-ring.

    A ring that leaves the form undetermined gets the one of least Frobenius norm, which does
    not depend on the choice of the x axis: hence the factor sqrt(2) at x y.
    """
    xyz = canonical(ring, unit_normal(ring, normal))
    _, n, m = xyz.shape
    columns = np.empty((4, n, m))
    for i in range(n):
        for k in range(m):
            x, y, z = at(xyz, i, k)
            columns[0, i, k] = x * x
            columns[1, i, k] = math.sqrt(2) * x * y
            columns[2, i, k] = y * y
            columns[3, i, k] = z
    a, b, c = least_squares(columns)
    b = math.sqrt(2) * b
    return 4 * a * c - b * b, a + c
