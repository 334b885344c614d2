"""An osculating jet: a polynomial of some degree, fitted over some rings."""

from typing import Literal

from curvlib.kit.compiled import kernel
from curvlib.kit.options import Length
from curvlib.kit.polynomial import fit_polynomial
from curvlib.kit.tensor import from_graph
from curvlib.kit.vectors import tangents

LABEL = "Jet"
SOURCE = "https://doi.org/10.1016/j.cagd.2004.09.004"
STYLE = {"color": "#332288", "marker": "x", "linestyle": "--"}


@kernel
def estimate(
    disk,
    degree: Literal[2, 3, 4, 5, 6] = 2,
    rings: Literal[2, 1, 3, 4] = 2,
    radius: Length = None,
):
    """All of K, H, k1, k2, d1 and d2 of z = sum c_ij x^i y^j, i + j <= degree, fitted by least
    squares to the vertex and its neighbours; z is along the normal of the vertex's triangles
    weighted by area.

    Parameters
    ----------
    disk : Disk
        A vertex and its neighbours.
    degree : {2, 3, 4, 5, 6}
        Of the polynomial.
    rings : {2, 1, 3, 4}
        How many rings of neighbours.
    radius : length, optional
        Instead of `rings`, the neighbours within this distance.

    Returns
    -------
    Curvatures
        Pointwise, in 1/length^2 and 1/length, positive where the surface bends away from its
        normal; d1 and d2 are NaN at an umbilic. NaN: needs a disk or half-disk of triangles, whose
        vertices determine a jet of degree 2. Where they do not determine `degree`, as on two rings
        for degree 5 or at a corner of the boundary, the jet has the highest degree that they do,
        and its order. Vertices on a boundary have values.

    Notes
    -----
    K and H are those of the jet's graph above the vertex, exact for polynomial graphs of the degree
    whatever the normal. CGAL's `Monge_via_jet_fitting` makes the same fit in the frame of the
    principal axes of the neighbours.

    Order: O(h^(degree - 1)) on any mesh that determines the jet (Cazals and Pouget 2005);
    one more for an even degree where neighbours lie symmetrically about the vertex.

    Source: Cazals, Pouget (2005), Estimating differential quantities using polynomial fitting of
    osculating jets.
    """
    N = disk.normal
    X, Y = tangents(N)
    derivatives, _ = fit_polynomial(disk, X, Y, N, 0, degree)
    return from_graph(*derivatives, X, Y, N)[0]
