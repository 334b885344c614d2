"""Torus about z: (|(x, y)| - 2)^2 + z^2 = 0.49."""

import numpy as np

from curvlib.implicit._exact import symmetric

LABEL = "Torus"
BOX = (2.9, 2.9, 0.9)
CLOSED = True
RADII = 2.0, 0.7


def level(x, y, z):
    """K = cos t / (r (R + r cos t)), H = (R + 2 r cos t) / (2 r (R + r cos t))."""
    R, r = RADII
    around = np.hypot(x, y)
    # On the axis f is not differentiable, and far from the surface.
    with np.errstate(divide="ignore", invalid="ignore"):
        c, s, over = np.nan_to_num(x / around), np.nan_to_num(y / around), R / around
    gradient = np.stack((2 * (x - R * c), 2 * (y - R * s), 2 * z))
    xx, yy, xy = 2 - 2 * over * s * s, 2 - 2 * over * c * c, 2 * over * c * s
    return (around - R) ** 2 + z * z - r * r, gradient, symmetric(xx, yy, 2, xy, 0, 0)
