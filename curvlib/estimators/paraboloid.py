"""Paraboloid fitting, section 3.1."""

import math

from curvlib.fit import least_squares
from curvlib.ring import Normal

LABEL = "Paraboloid fitting"
STYLE = {"color": "#D55E00", "marker": "o", "linestyle": "-"}


def estimate(ring, normal: Normal = "uniform"):
    """K and H by (3.5) of z = a x^2 + b x y + c y^2 (3.4), least squares over the one-ring.

    A ring that leaves the form undetermined gets the one of least Frobenius norm, which does
    not depend on the choice of the x axis: hence the factor sqrt(2) at x y.
    """
    x, y, z = ring.canonical(normal)
    a, b, c = least_squares((x * x, math.sqrt(2) * x * y, y * y), z)
    b = math.sqrt(2) * b
    return 4 * a * c - b * b, a + c
