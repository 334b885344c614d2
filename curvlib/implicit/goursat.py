"""Goursat's quartic x^4 + y^4 + z^4 - 0.5 (x^2 + y^2 + z^2) = 0.5: a rounded cube, dented."""

import numpy as np

from curvlib.implicit._exact import symmetric

LABEL = "Goursat's cube"
BOX = (1.2, 1.2, 1.2)
CLOSED = True


def level(x, y, z):
    """Its sides are concave about the axes; rays from the origin meet it once."""
    f = x**4 + y**4 + z**4 - 0.5 * (x * x + y * y + z * z) - 0.5
    gradient = np.stack((4 * x**3 - x, 4 * y**3 - y, 4 * z**3 - z))
    return f, gradient, symmetric(12 * x * x - 1, 12 * y * y - 1, 12 * z * z - 1, 0, 0, 0)
