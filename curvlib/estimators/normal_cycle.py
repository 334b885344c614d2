"""The normal cycle of a mesh: the curvature of its edges, over one ring or a ball."""

import math

import numpy as np

from curvlib.kit.compiled import kernel
from curvlib.kit.cut import segment_within
from curvlib.kit.measures import dihedral
from curvlib.kit.options import Length
from curvlib.kit.ring import FLAT
from curvlib.kit.tensor import from_form
from curvlib.kit.vectors import add, at, cross, dot, norm, tangents

LABEL = "Normal cycle"
SOURCE = "https://doi.org/10.1145/777792.777839"
STYLE = {"color": "#44AA99", "marker": "h", "linestyle": "-"}


@kernel
def estimate(ball, radius: Length = None):
    """All of K, H, k1, k2, d1 and d2 of the tensor T = sum beta |e in B| t t^t / area(B) over the
    edges e of a ball B, beta being the signed dihedral angle at e and t its unit direction. In the
    tangent plane its eigenvectors are the principal directions, and that of k1 belongs to k2.

    Parameters
    ----------
    ball : Ball
        The triangles near a vertex.
    radius : length, optional
        Of B, which cuts edges and triangles exactly. Without it, the cell of the vertex: half of
        each of its edges and a third of each of its triangles.

    Returns
    -------
    Curvatures
        Pointwise, in 1/length^2 and 1/length, positive where the surface bends away from its
        normal; d1 and d2 are NaN at an umbilic. NaN: needs a disk or half-disk of triangles, two or
        more within the radius, that does not fold onto itself there (`curvlib.kit.ring.beta`).
        Vertices on a boundary have values: its edges have no angle, and the area is that of the
        triangles there.

    Notes
    -----
    H is half the trace of T, the mean curvature measure over the area, without a radius that of
    `gauss_bonnet`. K = k1 k2, where k1 - k2 is that of T in the plane normal to the vertex's normal
    weighted by area. The plane is defined also where two eigenvalues of T vanish, as on a cylinder,
    and T has a part along its normal, of the order of (curvature radius)^2, that belongs to H: with
    it errors are up to a half smaller. The Gauss measure over a ball is `pooled_deficit`.

    Edges at a triangle lower than FLAT times its sides have no angle.

    Order: O(radius + h / radius) on meshes whose triangles have angles above a bound, so O(sqrt(h))
    for a radius ~ sqrt(h) (Cohen-Steiner and Morvan 2003); there h^0.7 to h are measured. Over one
    ring the error does not vanish on irregular meshes.

    Source: Cohen-Steiner, Morvan (2003), Restricted Delaunay triangulations and normal cycle.
    """
    N = ball.normal
    X, Y = tangents(N)
    area = trace = xx = xy = yy = 0.0
    edges = 0
    points, triangles = ball.points, ball.triangles
    for i in range(triangles.shape[1]):
        own = _facet(ball, i)
        area += ball.inside[i] * norm(own) / 2
        for k in range(3):
            j = ball.across[k, i]
            # Each edge once, from the first of its two triangles.
            other = _facet(ball, j) if j > i else own
            if j > i and dot(own, own) > 0 and dot(other, other) > 0:
                p, q = at(points, triangles[k, i]), at(points, triangles[(k + 1) % 3, i])
                start, end = segment_within(p, q, ball.radius)
                if start < end:
                    edges += 1
                    e = add(q, -1.0, p)
                    square, x, y = dot(e, e), dot(e, X), dot(e, Y)
                    weight = (end - start) * dihedral(e, own, other) / np.sqrt(square)
                    trace += weight * square
                    xx, xy, yy = xx + weight * x * x, xy + weight * x * y, yy + weight * y * y
    if ball.radius == math.inf:
        area, trace, xx, xy, yy = area / 3, trace / 2, xx / 2, xy / 2, yy / 2
    if edges == 0:
        area = np.nan
    rest = (trace - xx - yy) / 2
    return from_form((yy + rest) / area, -xy / area, (xx + rest) / area, X, N)


@kernel
def _facet(ball, i):
    """The normal of triangle i, twice its area long; zero where rounding decides its direction."""
    points, corners = ball.points, ball.triangles
    a, b, c = at(points, corners[0, i]), at(points, corners[1, i]), at(points, corners[2, i])
    e, g = add(b, -1.0, a), add(c, -1.0, a)
    facet = cross(e, g)
    sides = 2 * (dot(e, e) + dot(g, g) - dot(e, g))
    if dot(facet, facet) > (FLAT * sides) ** 2:
        return facet
    return 0.0, 0.0, 0.0
