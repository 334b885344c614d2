"""Frustum of a cone, radius 1 to 0.4 over a height of 1.5: K = 0, H = cos(slope) / 2r."""

from ._shapes import revolve

LABEL = "Cone (frustum)"


def build():
    """u runs around, v upwards."""
    return revolve(1, [0, 0, 1, 1], [(1, 0), (0.4, 1.5)])
