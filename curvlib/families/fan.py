"""Long thin triangles and fans, as tessellators make them of CAD models."""

import numpy as np

from curvlib.families._charts import with_exact
from curvlib.meshes.mesh import Mesh

LABEL = "CAD fans"
SURFACES = ("cylinder", "sphere")
HEIGHT = 6.0  # of the cylinder of radius 1
RINGS = 3  # of vertices on its side, besides the two rims


def make(surface, n, seed):
    """n strips around the axis; nothing is random.

    The cylinder of radius 1 and height 6 has three rings of vertices on its side, and a fan of n
    triangles as each cap; its rims are sharp, where vertices are not `smooth`. The sphere has n / 8
    rings of vertices, at least three, and fans at its poles.
    """
    if surface == "sphere":
        rings = max(n // 8, 3)
        heights = np.pi * (np.arange(1, rings + 1) / (rings + 1) - 0.5)
        points = _rings(np.cos(heights), np.sin(heights), n)
        points = np.concatenate([points, [[0, 0, -1], [0, 0, 1]]])
        return with_exact(surface, points, _strips(rings, n))
    levels = HEIGHT * np.linspace(-0.5, 0.5, RINGS + 2)
    points = _rings(np.ones(RINGS + 2), levels, n)
    points = np.concatenate([points, [[0, 0, levels[0]], [0, 0, levels[-1]]]])
    x, y, z = points.T
    caps = np.hypot(x, y) < 0.5
    smooth = caps | (np.abs(z) < levels[-1] * (1 - 1e-9))
    zero, side = 0 * x, np.where(smooth & ~caps, 1.0, 0.0)
    axis = np.column_stack((zero, zero, zero + 1))
    around = np.column_stack((-y, x, zero))
    normals = np.where(caps[:, None], axis * np.sign(z)[:, None], np.column_stack((x, y, zero)))
    lost = np.where(smooth, 0, np.nan)
    umbilic = np.where(side == 1, 0, np.nan)[:, None]
    return Mesh(
        points,
        _strips(RINGS + 2, n),
        normals=normals,
        smooth=smooth,
        K=lost,
        H=side / 2 + lost,
        k1=side + lost,
        k2=lost,
        d1=around + umbilic,
        d2=axis + umbilic,
    )


def _rings(radii, heights, n):
    """Points (rings n, 3) of circles about z."""
    angles = 2 * np.pi * np.arange(n) / n
    circle = np.stack((np.cos(angles), np.sin(angles)), -1)
    rings = radii[:, None, None] * circle
    levels = np.broadcast_to(heights[:, None, None], (*rings.shape[:2], 1))
    return np.concatenate([rings, levels], -1).reshape(-1, 3)


def _strips(rings, n):
    """Triangles between rings of n points, upwards, and fans to the two points after them."""
    i, j = np.divmod(np.arange((rings - 1) * n), n)
    a, b = i * n + j, i * n + (j + 1) % n
    low = np.arange(n)
    high, bottom = low + (rings - 1) * n, rings * n
    after = (low + 1) % n
    fans = [
        np.stack((0 * low + bottom, after, low), -1),
        np.stack((0 * low + bottom + 1, high, after + (rings - 1) * n), -1),
    ]
    between = [np.stack((a, b, b + n), -1), np.stack((a, b + n, a + n), -1)]
    return np.concatenate([*between, *fans])
