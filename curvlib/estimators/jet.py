"""An osculating jet: a polynomial of some degree, fitted over some rings."""

from typing import Literal

import numpy as np

from curvlib.kit.compiled import kernel
from curvlib.kit.options import Length
from curvlib.kit.polynomial import fit_polynomial
from curvlib.kit.tensor import from_graph
from curvlib.kit.vectors import tangents
from curvlib.kit.wider import wider

LABEL = "Jet"
SOURCE = "https://doi.org/10.1016/j.cagd.2004.09.004"
STYLE = {"color": "#332288", "marker": "x", "linestyle": "--"}

# The rings up to which a neighbourhood grows; and the smallest sine of the angle between the column
# of a monomial and the span of those of higher ones.
WIDEST, SINE = 5, 3e-3


@kernel
def estimate(
    disk,
    degree: Literal[2, 3, 4, 5, 6] = 2,
    rings: Literal[2, 1, 3, 4, 5, 6, 8, 10] = 2,
    radius: Length = None,
    fit: Literal["interpolation", "approximation"] = "interpolation",
):
    """All of K, H, k1, k2, d1 and d2 of z = sum c_ij x^i y^j, i + j <= degree, fitted by least
    squares to the neighbours; z is along the normal of the vertex's triangles weighted by area.

    Parameters
    ----------
    disk : Disk
        A vertex and its neighbours.
    degree : {2, 3, 4, 5, 6}
        Of the polynomial.
    rings : {2, 1, 3, 4, 5, 6, 8, 10}
        How many rings of neighbours.
    radius : length, optional
        Instead of `rings`, the neighbours within this distance.
    fit : {"interpolation", "approximation"}
        Interpolation: the jet passes through the vertex, and a residual in ring k has the weight
        exp(-(k / rings)^2); with a radius exp(-(distance / largest distance)^2). Approximation: the
        vertex is a point like others, all of weight 1.

    Returns
    -------
    Curvatures
        Pointwise, in 1/length^2 and 1/length, positive where the surface bends away from its
        normal; d1 and d2 are NaN at an umbilic. NaN: needs a disk or half-disk of triangles, whose
        vertices determine a jet of degree 2. Where they do not determine `degree`, as two rings do
        not for degree 5, three at the boundary not for degree 6, or where valences are small, rings
        are added one by one up to the fifth; the weights of those that are there stay. Where these,
        or the neighbours within `radius`, do not suffice, the jet has the highest degree that they
        determine, and its order. Vertices on a boundary have values.

    Notes
    -----
    K and H are those of the jet's graph above the vertex, exact for polynomial graphs of the degree
    whatever the normal. CGAL's `Monge_via_jet_fitting` makes the approximation in the frame of the
    principal axes of the neighbours.

    Points determine a jet if the column of each monomial has an angle of sine 3e-3 or more to the
    span of those of higher ones: the pivots of L D L^T are the squares of these sines.

    Accuracy at exact vertices is best with the even degree on the fewest rings that determine it,
    4 on 2 and 6 on 3: on a torus of 2,500 irregular vertices errors of K are 1/5 and 1/19 of those
    of degree 4 on 3 rings by approximation. Interpolation has 0.4 to 0.9 of the errors of
    approximation there, but 1.1 to 2 times where noise rules, which for degree 4 is from 1e-3 of an
    edge on.

    Order: O(h^(degree - 1)) on any mesh that determines the jet (Cazals and Pouget 2005); one more
    for an even degree where neighbours lie symmetrically about the vertex.

    Source: Cazals, Pouget (2005), Estimating differential quantities using polynomial fitting of
    osculating jets.
    """
    N = disk.normal
    X, Y = tangents(N)
    derivatives, _, _ = fit_jet(disk, X, Y, N, degree, rings, fit == "interpolation")
    return from_graph(*derivatives, X, Y, N)[0]


@kernel
def fit_jet(disk, X, Y, N, degree, rings, interpolating):
    """Fit a jet in a frame, on more rings where those there do not determine the degree.

    Parameters
    ----------
    disk : Disk
    X, Y, N : tuple of 3 floats
        A right-handed orthonormal frame.
    degree, rings : int
    interpolating : bool
        Whether through the vertex, with weights by ring.

    Returns
    -------
    derivatives : tuple of 5 floats
    degree : int
        As of `fit_polynomial`.
    disk : Disk
        With the rings that were taken.
    """
    while True:
        if interpolating:
            weigh(disk, rings)
        derivatives, reached = fit_polynomial(
            disk, X, Y, N, 1 if interpolating else 0, degree, SINE
        )
        narrow = disk.count
        if reached == degree or disk.walk.rings >= WIDEST:
            return derivatives, reached, disk
        disk, _ = wider(disk)
        if disk.count == narrow:
            return derivatives, reached, disk


@kernel
def weigh(disk, rings):
    """Set the weights of interpolation.

    Parameters
    ----------
    disk : Disk
    rings : int
        At which the weight is 1/e.
    """
    if disk.walk.rings > 0:
        hop, weight = 0, 1.0
        for i in range(disk.count):
            if disk.hops[i] != hop:
                hop = disk.hops[i]
                weight = np.exp(-((hop / rings) ** 2))
            disk.weights[i] = weight
    else:
        inverse = 1 / (disk.radius * disk.radius)
        for i in range(disk.count):
            x, y, z = disk.e[0, i], disk.e[1, i], disk.e[2, i]
            disk.weights[i] = np.exp(-(x * x + y * y + z * z) * inverse)
