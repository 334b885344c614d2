"""Moments of the solid that a surface bounds, inside a ball about the vertex."""

import math

from curvlib.kit.compiled import kernel
from curvlib.kit.options import Length
from curvlib.kit.solid import solid
from curvlib.kit.tensor import from_form
from curvlib.kit.vectors import divide, norm, tangents

LABEL = "Integral invariant"
SOURCE = "https://doi.org/10.1016/j.cagd.2008.01.002"
STYLE = {"color": "#882255", "marker": "P", "linestyle": "-"}
BOUNDED = "behind an edge of the boundary there is no solid"


@kernel
def estimate(ball, radius: Length = "5 edges"):
    """All of K, H, k1, k2, d1 and d2 of the covariance M of the solid inside a ball of radius r
    about the vertex, by M_XX = 2 pi r^5 / 15 - pi r^6 (3 k_XX + k_YY) / 48 and
    M_XY = -pi r^6 k_XY / 24, X and Y being orthogonal to the barycentre.

    The surface is that of the triangles, cut exactly by the sphere; a part of the mesh inside the
    ball that is not connected to the vertex there does not count.

    Parameters
    ----------
    ball : Ball
        The triangles within r of a vertex.
    radius : length
        Of the ball: r.

    Returns
    -------
    Curvatures
        Pointwise, in 1/length^2 and 1/length, positive where the surface bends away from its
        normal; d1 and d2 are NaN at an umbilic. NaN: needs a ball that cuts the mesh, and no edge
        of the boundary inside it, where the surface bounds no solid; a ball that holds the whole of
        a closed mesh says nothing about one of its vertices.

    Notes
    -----
    The covariance about the barycentre is the same in X and Y. The paper takes its eigenvectors,
    which lie farther from the tangent plane (on a torus by 0.86 instead of 0.71 degrees, r being
    0.6 radii of the tube); the eigenvalues give the same curvatures to 1 per cent.

    The volume is V = 2 pi r^3 / 3 - pi r^4 H / 4, exact on spheres, where M gives
    k1 = k2 = (1 - r^2 / 16 R^2) / R. H is that of M nevertheless: an error e of the vertex along
    its normal changes it by 3 e / r^2, and the H of V by 4 e / r^2. So M is the better where
    coordinates are not exact, and on meshes inscribed in a surface, where vertices stand out from
    the solid: with all edges of length h, H is too large by the part 3 h^2 / 8 r^2 and K by twice
    that, 1.5 and 3 per cent for 5 edges; 1.8 and 3.6 per cent on a jittered mesh.

    Order: O(r) for the solid of a smooth surface (Pottmann, Wallner, Yang, Lai, Hu 2007); on meshes
    with vertices on the surface O(r^2 + h^2 / r^2), measured, so O(h) for r^2 = h and none for r in
    edges.

    Source: Pottmann, Wallner, Huang, Yang (2009), Integral invariants for robust geometry
    processing; the covariance of digital shapes: Coeurjolly, Lachaud, Levallois (2014),
    Multigrid convergent principal curvature estimators in digital geometry.
    """
    r = ball.radius
    _, first, second = solid(ball)
    N = divide(first, -norm(first))
    X, Y = tangents(N)
    xx, xy, yy = _form(second, X, X), _form(second, X, Y), _form(second, Y, Y)
    factor, flat = 6 / (math.pi * r**6), 8 / (5 * r)
    a, c = factor * (yy - 3 * xx) + flat, factor * (xx - 3 * yy) + flat
    return from_form(a, -4 * factor * xy, c, X, N)


@kernel
def _form(second, a, b):
    """a . M b of a symmetric matrix M: xx, xy, xz, yy, yz, zz."""
    xx, xy, xz, yy, yz, zz = second
    return (
        a[0] * (xx * b[0] + xy * b[1] + xz * b[2])
        + a[1] * (xy * b[0] + yy * b[1] + yz * b[2])
        + a[2] * (xz * b[0] + yz * b[1] + zz * b[2])
    )
