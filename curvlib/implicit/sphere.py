"""The unit sphere: |x|^2 = 1."""

import numpy as np

from curvlib.implicit._exact import symmetric

LABEL = "Sphere"
BOX = (1.2, 1.2, 1.2)
CLOSED = True


def level(x, y, z):
    """K = H = 1."""
    gradient = np.stack((2 * x, 2 * y, 2 * z))
    return x * x + y * y + z * z - 1, gradient, symmetric(2 + 0 * x, 2, 2, 0, 0, 0)
