"""Sphere of radius 1 about the origin: K = 1, H = 1."""

from ._shapes import SQRT_HALF, revolve

LABEL = "Sphere"


def build():
    """u runs around the z axis, v from the south pole to the north pole."""
    half_circle = [(0, -1), (1, -1), (1, 0), (1, 1), (0, 1)]
    weights = [1, SQRT_HALF, 1, SQRT_HALF, 1]
    return revolve(2, [0, 0, 0, 0.5, 0.5, 1, 1, 1], half_circle, weights)
