"""The area of the Gauss image of a one-ring over the area of the ring."""

import math

from curvlib.kit.compiled import compiled, kernel
from curvlib.kit.ring import total, zeros
from curvlib.kit.vectors import at, cross, dot

LABEL = "Meek-Walton"
SOURCE = "https://doi.org/10.1016/S0167-8396(00)00006-6"
STYLE = {"color": "#882255", "marker": "h", "linestyle": "-"}


@kernel
def normals(disk):
    """The normal of the triangles of `disk`, weighted by area."""
    return disk.normal


@compiled
def estimate(ring, normals):
    """K = sum Omega_i / A, Omega_i being the area of the spherical triangle of the normals at v,
    v_i and v_{i+1}, with its sign, and A the area of the ring.

    Parameters
    ----------
    ring : Ring
        Batch of m closed one-rings of one valence n.
    normals : (3, 1 + n, m)
        Unit normals of the vertex and its neighbours.

    Returns
    -------
    K : ndarray, (m,)
        Pointwise, in 1/length^2; negative where the spherical triangles run clockwise seen from
        outside. H is not estimated. NaN: needs a closed one-ring, whose vertices have normals.

    Notes
    -----
    K is the limit of the area of the Gauss image of a region over the area of the region. With the
    normals of the triangles instead, the image of the point v is a polygon whose area is the angle
    deficit: that is `gauss_bonnet`, with a third of A for the region.

    Order: with exact normals O(h), and O(h^2) where neighbours lie symmetrically about the vertex;
    with those of triangles, O(h) off on irregular meshes, the error does not vanish there.

    Source: Meek, Walton (2000), On surface normal and Gaussian curvature approximations given data
    sampled from a smooth surface, the spherical image.
    """
    n, m = ring.areas.shape
    image, areas = zeros(m), total(ring.areas)
    for i in range(n):
        j = (i + 1) % n
        for k in range(m):
            a, b, c = at(normals, 0, k), at(normals, 1 + i, k), at(normals, 1 + j, k)
            # Van Oosterom and Strackee (1983): tan(Omega / 2).
            triple, cosines = dot(a, cross(b, c)), 1 + dot(a, b) + dot(b, c) + dot(c, a)
            image[k] += 2 * math.atan2(triple, cosines)
    for k in range(m):
        image[k] /= areas[k]
    return image, None
