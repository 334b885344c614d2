"""A quadric through the vertex, fitted over some rings."""

from typing import Literal

from curvlib.kit.compiled import kernel
from curvlib.kit.options import Length
from curvlib.kit.polynomial import fit_polynomial
from curvlib.kit.tensor import from_graph
from curvlib.kit.vectors import tangents

LABEL = "Quadric"
SOURCE = "https://libigl.github.io/dox/principal__curvature_8h.html"
STYLE = {"color": "#332288", "marker": "+", "linestyle": "-"}


@kernel
def estimate(disk, rings: Literal[2, 1, 3] = 2, radius: Length = None):
    """All of K, H, k1, k2, d1 and d2 of z = a x^2 + b x y + c y^2 + d x + e y, fitted by least
    squares to the neighbours; z is along the normal of the vertex's triangles weighted by area.

    Parameters
    ----------
    disk : Disk
        A vertex and its neighbours.
    rings : {2, 1, 3}
        How many rings of neighbours.
    radius : length, optional
        Instead of `rings`, the neighbours within this distance.

    Returns
    -------
    Curvatures
        Pointwise, in 1/length^2 and 1/length, positive where the surface bends away from its
        normal; d1 and d2 are NaN at an umbilic. NaN: needs a disk or half-disk of triangles, whose
        vertices determine the quadric: five neighbours, not on a conic through the vertex in the
        tangent plane. So vertices on a boundary have values, of the same order.

    Notes
    -----
    K and H are those of the fitted graph at the vertex, exact for a quadric graph whatever the
    normal. Libigl's `principal_curvature` makes the same fit, but takes principal values of a
    matrix that it has made symmetric: the sum of its two is 2 H, its K differs by the square of the
    graph's slope, O(h^2).

    Order: O(h) on any mesh that determines the quadric (Cazals and Pouget 2005, degree 2); O(h^2)
    where neighbours lie symmetrically about the vertex.

    Source: Panozzo, Puppo, Rocca (2010), Efficient multi-scale curvature and crease estimation.
    """
    N = disk.normal
    X, Y = tangents(N)
    derivatives, _ = fit_polynomial(disk, X, Y, N, 1, 2)
    return from_graph(*derivatives, X, Y, N)[0]
