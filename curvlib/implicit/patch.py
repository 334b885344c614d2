"""The open graph over [-1, 1]^2 of z = 0.5 x^2 - 0.3 y^2 + 0.15 sin(3 x) cos(2 y)."""

import numpy as np

from curvlib.implicit._exact import symmetric
from curvlib.meshes.jittered import wavy

LABEL = "Patch"
BOX = (1.0, 1.0, 1.0)
CLOSED = False


def level(x, y, z):
    """z less the height."""
    (s, c), (sy, cy) = (np.sin(3 * x), np.cos(3 * x)), (np.sin(2 * y), np.cos(2 * y))
    gradient = np.stack((-x - 0.45 * c * cy, 0.6 * y + 0.3 * s * sy, 1 + 0 * z))
    xx, yy = -1 + 1.35 * s * cy, 0.6 + 0.6 * s * cy
    return z - wavy(x, y), gradient, symmetric(xx, yy, 0, 0.9 * c * sy, 0, 0)
