"""A cell of the gyroid's level set sin x cos y + sin y cos z + sin z cos x = 0: open."""

import numpy as np

from curvlib.implicit._exact import symmetric

LABEL = "Gyroid"
BOX = (3.1, 3.1, 3.1)
CLOSED = False


def level(x, y, z):
    """Near to a minimal surface: K < 0 nearly everywhere, H small."""
    (sx, sy, sz), (cx, cy, cz) = np.sin((x, y, z)), np.cos((x, y, z))
    f = sx * cy + sy * cz + sz * cx
    gradient = np.stack((cx * cy - sz * sx, cy * cz - sx * sy, cz * cx - sy * sz))
    squares = -sx * cy - sz * cx, -sy * cz - sx * cy, -sz * cx - sy * cz
    return f, gradient, symmetric(*squares, -cx * sy, -cz * sx, -cy * sz)
