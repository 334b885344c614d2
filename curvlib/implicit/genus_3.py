"""A shell with four openings, genus 3: |x|^4 - 2 |x|^2 + 0.8 = 2 x y z."""

import numpy as np

from curvlib.implicit._exact import symmetric

LABEL = "Genus 3"
BOX = (1.3, 1.3, 1.3)
CLOSED = True


def level(x, y, z):
    """The openings lie where x y z is negative, about the directions (-1, -1, -1), (-1, 1, 1)..."""
    s = x * x + y * y + z * z
    along = 4 * (s - 1)
    gradient = np.stack((along * x - 2 * y * z, along * y - 2 * x * z, along * z - 2 * x * y))
    squares = (along + 8 * x * x, along + 8 * y * y, along + 8 * z * z)
    hessian = symmetric(*squares, 8 * x * y - 2 * z, 8 * x * z - 2 * y, 8 * y * z - 2 * x)
    return s * s - 2 * s + 0.8 - 2 * x * y * z, gradient, hessian
