"""Ellipsoid with semi-axes 1.5, 1 and 0.75 along x, y and z: the sphere, scaled."""

from . import sphere
from ._shapes import scale

LABEL = "Ellipsoid"

SEMI_AXES = (1.5, 1.0, 0.75)


def build():
    """u runs around the z axis, v from the south pole to the north pole."""
    return scale(sphere.build(), SEMI_AXES)
