"""Ellipsoid with semi-axes 1.5, 1 and 0.75 along x, y and z: the sphere, scaled."""

import numpy as np

from . import sphere
from ._shapes import nurbs

LABEL = "Ellipsoid"

SEMI_AXES = (1.5, 1.0, 0.75)


def build():
    """u runs around the z axis, v from the south pole to the north pole."""
    unit = sphere.build()
    shape = (unit.ctrlpts_size_u, unit.ctrlpts_size_v)
    net = np.reshape(unit.ctrlpts, (*shape, 3)) * SEMI_AXES
    knots = (unit.knotvector_u, unit.knotvector_v)
    return nurbs(unit.degree, knots, net, np.reshape(unit.weights, shape))
