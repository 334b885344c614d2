"""Cylinder of radius 1 and height 2 about the z axis, open at both ends: K = 0, H = 1/2."""

from ._shapes import revolve

LABEL = "Cylinder"


def build():
    """u runs around, v upwards."""
    return revolve(1, [0, 0, 1, 1], [(1, -1), (1, 1)])
