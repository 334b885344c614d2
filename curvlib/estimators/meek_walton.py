"""The area of the Gauss image of the triangles at a vertex over their own area."""

import math

import numpy as np

from curvlib.kit.compiled import kernel
from curvlib.kit.disk import normals as normals
from curvlib.kit.vectors import add, at, cross, dot, norm

LABEL = "Meek-Walton"
SOURCE = "https://doi.org/10.1016/S0167-8396(00)00006-6"
STYLE = {"color": "#882255", "marker": "h", "linestyle": "-"}


@kernel
def estimate(ball, normals):
    """K = sum Omega_i / sum A_i over the triangles at the vertex, Omega_i being the area of the
    spherical triangle of the normals at its corners, with its sign, and A_i its own area.

    Parameters
    ----------
    ball : Ball
        The triangles at the vertex.
    normals : (3, n)
        Unit normals of the vertex and its neighbours.

    Returns
    -------
    K : float
        Pointwise, in 1/length^2; negative where the spherical triangles run clockwise seen from
        outside. H is not estimated. NaN: needs a disk or half-disk of triangles. Triangles with a
        corner that has no normal are left out of both sums. Vertices on a boundary have values.

    Notes
    -----
    K is the limit of the area of the Gauss image of a region over the area of the region. With the
    normals of the triangles instead, the image of the vertex is a polygon whose area is the angle
    deficit: that is `gauss_bonnet`, with a third of the area of its triangles for the region.

    Order: with exact normals O(h), and O(h^2) where neighbours lie symmetrically about the vertex;
    with those of triangles, O(h) off on irregular meshes, the error does not vanish there.

    Source: Meek, Walton (2000), On surface normal and Gaussian curvature approximations given data
    sampled from a smooth surface, the spherical image.
    """
    image = area = 0.0
    for t in range(ball.triangles.shape[1]):
        i, j, k = ball.triangles[0, t], ball.triangles[1, t], ball.triangles[2, t]
        a, b, c = at(normals, i), at(normals, j), at(normals, k)
        # Van Oosterom and Strackee (1983): tan(Omega / 2).
        triple, cosines = dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a)
        if math.isfinite(triple):
            v = at(ball.points, i)
            facet = cross(add(at(ball.points, j), -1.0, v), add(at(ball.points, k), -1.0, v))
            image, area = image + 2 * math.atan2(triple, cosines), area + norm(facet) / 2
    return image / area if area > 0 else np.nan, None
