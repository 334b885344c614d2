"""Curvature measures of a triangle mesh: integrals over parts of it, from triangles and edges.

A measure over its area is a mean curvature of the part. Here all arguments are triples of numbers;
lengths are in the unit of the mesh.
"""

import math

import numpy as np

from .compiled import kernel
from .ring import SHEET
from .vectors import add, cross, dot, norm


@kernel
def corrected_measures(a, b, c, ua, ub, uc):
    """Corrected curvature measures of a triangle, whose normal is interpolated linearly between
    those of its corners, and not normalised.

    Parameters
    ----------
    a, b, c : tuple of 3 floats
        The corners, counter-clockwise seen from outside.
    ua, ub, uc : tuple of 3 floats
        Unit normals of the surface there.

    Returns
    -------
    mu0, mu1, mu2 : float
        The area, twice the integral of H, the integral of K.
    muXY : tuple of 3 tuples of 3 floats
        Rows of a tensor T: x . T y is the integral of the second fundamental form in directions x
        and y, negative where the surface bends away from its normal; its trace is -mu1.

    Notes
    -----
    On a sphere with exact normals mu1 / 2 mu0 = 1 / radius and mu2 / mu0 = 1 / radius^2.

    Source: Lachaud, Romon, Thibert, Coeurjolly (2020), Interpolated corrected curvature measures
    for polygonal surfaces.
    """
    u = (ua[0] + ub[0] + uc[0]) / 3, (ua[1] + ub[1] + uc[1]) / 3, (ua[2] + ub[2] + uc[2]) / 3
    e, g, p, q = add(b, -1.0, a), add(c, -1.0, a), add(ub, -1.0, ua), add(uc, -1.0, ua)
    mu0 = dot(u, cross(e, g)) / 2
    mu1 = (dot(u, cross(e, q)) + dot(u, cross(p, g))) / 2
    mu2 = dot(ua, cross(ub, uc)) / 2
    # T = ((e x u) q^t - (g x u) p^t) / 2.
    r, s = cross(e, u), cross(g, u)
    muXY = _row(r[0], q, s[0], p), _row(r[1], q, s[1], p), _row(r[2], q, s[2], p)
    return mu0, mu1, mu2, muXY


@kernel
def _row(x, q, y, p):
    return (x * q[0] - y * p[0]) / 2, (x * q[1] - y * p[1]) / 2, (x * q[2] - y * p[2]) / 2


@kernel
def dihedral(edge, left, right):
    """Signed dihedral angle at an edge, as `curvlib.kit.ring.beta`.

    Parameters
    ----------
    edge : tuple of 3 floats
        From one end to the other; counter-clockwise in the triangle `left`.
    left, right : tuple of 3 floats
        Normals of its triangles, of any length but zero.

    Returns
    -------
    float
        In (-pi, pi), convex positive; NaN within SHEET of +-pi.
    """
    angle = math.atan2(dot(edge, cross(left, right)), norm(edge) * dot(left, right))
    return angle if abs(angle) < math.pi - SHEET else np.nan
