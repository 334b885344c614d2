"""Ellipsoid of semi-axes 1, 0.8 and 0.6."""

import numpy as np

from curvlib.implicit._exact import symmetric

LABEL = "Ellipsoid"
BOX = (1.2, 1.0, 0.8)
CLOSED = True
SEMI_AXES = 1.0, 0.8, 0.6


def level(x, y, z):
    """x^2 / a^2 + y^2 / b^2 + z^2 / c^2 - 1."""
    a, b, c = (2 / axis**2 for axis in SEMI_AXES)
    f = (a * x * x + b * y * y + c * z * z) / 2 - 1
    return f, np.stack((a * x, b * y, c * z)), symmetric(a + 0 * x, b, c, 0, 0, 0)
