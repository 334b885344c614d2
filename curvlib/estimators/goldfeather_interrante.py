"""A cubic through the vertex, fitted to its neighbours and to their normals."""

import numpy as np

from curvlib.kit.compiled import kernel
from curvlib.kit.disk import normals as normals
from curvlib.kit.lanes import LANES, dot, multiply
from curvlib.kit.parts import part
from curvlib.kit.polynomial import MOMENTS, MONOMIALS, monomials, solve, sum_moments, terms
from curvlib.kit.tensor import from_graph
from curvlib.kit.vectors import tangents

LABEL = "Goldfeather-Interrante"
SOURCE = "https://doi.org/10.1145/966131.966134"
STYLE = {"color": "#117733", "marker": "d", "linestyle": "-"}

# Cosines of the angle to the vertex's normal from which on a neighbour has all of its weight, 60
# degrees, and down to which it has some, 84 degrees. A slope is 10 at most, and no rounding of a
# right angle decides whether there is one.
FULL, STEEP = 0.5, 0.1


@kernel
def estimate(disk, normals):
    """All of K, H, k1, k2, d1 and d2 of z = a/2 x^2 + b x y + c/2 y^2 + d x^3 + e x^2 y + f x y^2 +
    g y^3, fitted by least squares to the positions and slopes of the one-ring; z is along the
    normal of the vertex.

    Parameters
    ----------
    disk : Disk
        A vertex and its one-ring.
    normals : (3, 1 + n)
        Unit normals N_i of the vertex and its neighbours.

    Returns
    -------
    Curvatures
        Pointwise, in 1/length^2 and 1/length, positive where the surface bends away from its
        normal; d1 and d2 are NaN at an umbilic. NaN: needs a disk or half-disk of triangles, whose
        neighbours have normals that determine a, b and c. Where they do not determine the cubic, as
        two neighbours at a corner of the boundary, the fit is quadratic. Vertices on a boundary
        have values.

    Notes
    -----
    Each neighbour gives three equations: z, and the slopes -N_x / N_z and -N_y / N_z along x and y.
    Lengths are in units of the longest edge, so that the weight of slopes beside z does not depend
    on the scale. Neighbours without a normal are left out; the weight of others falls from 1, where
    their normal is turned by up to 60 degrees, to 0 at 84 degrees.

    Order: O(h^2) on any mesh with exact normals, as for other fits of degree 3 (Cazals and Pouget
    2005). The normals of triangles are O(h) off on irregular meshes, where the error does not
    vanish. Measured on grids cut along one diagonal: O(h^2).

    Source: Goldfeather, Interrante (2004), A novel cubic-order algorithm for approximating
    principal direction vectors.
    """
    weights, radius, rows, space = disk.weights, disk.radius, disk.rows, disk.space
    N = normals[0, 0], normals[1, 0], normals[2, 0]
    X, Y = tangents(N)
    # Rows of slopes p and q lie behind those of `monomials`, x, y and z.
    z = 3 + terms(3) + 2
    p, q = z + 1, z + 2
    for i in range(len(weights)):
        rows[p, i] = rows[q, i] = 0.0
    for i in range(disk.count):
        x, y, along = 0.0, 0.0, 0.0
        for c in range(3):
            component = normals[c, 1 + i]
            x, y, along = x + component * X[c], y + component * Y[c], along + component * N[c]
        weight = min((along - STEEP) / (FULL - STEEP), 1.0) if along > STEEP else 0.0
        weights[i] = weight
        if weight > 0:
            rows[p, i], rows[q, i] = -weight * x / along, -weight * y / along
    monomials(disk, X, Y, N, 3)
    multiply(rows, z, z, 3)
    moments = part(space, 0, (MOMENTS,))
    sum_moments(rows, 2, 6, moments)
    for degree in (3, 2):
        size, last = terms(degree) - terms(1), terms(degree) - 1
        width = (size + LANES) // LANES * LANES
        system = part(space, MOMENTS + 2 * MONOMIALS, (size, width))
        for i in range(size):
            a, b = _powers(last - i)
            for k in range(width):
                system[i, k] = 0.0
            for k in range(i, size):
                system[i, k] = _product(moments, a, b, *_powers(last - k))
            height = dot(rows, 3 + last - i, z)
            height += a * dot(rows, 3 + _place(a - 1, b), p) if a > 0 else 0.0
            height += b * dot(rows, 3 + _place(a, b - 1), q) if b > 0 else 0.0
            system[i, size] = height
        if solve(system, 3, part(space, MOMENTS, (2 * MONOMIALS,))):
            xx, xy, yy = system[size - 1, size], system[size - 2, size], system[size - 3, size]
            return from_graph(0.0, 0.0, 2 * xx / radius, xy / radius, 2 * yy / radius, X, Y, N)[0]
    return from_graph(np.nan, np.nan, np.nan, np.nan, np.nan, X, Y, N)[0]


@kernel
def _place(a, b):
    """The place of x^a y^b in the order of monomials."""
    return terms(a + b - 1) + b


@kernel
def _powers(place):
    """The powers of x and y of the quadratic or cubic monomial at a place."""
    degree = 2 if place < terms(2) else 3
    b = place - terms(degree - 1)
    return degree - b, b


@kernel
def _product(moments, a, b, c, d):
    """The sum over the neighbours of the products of the three rows, z and slopes, of x^a y^b and
    x^c y^d."""
    total = moments[_place(a + c, b + d)]
    if a > 0 and c > 0:
        total += a * c * moments[_place(a + c - 2, b + d)]
    if b > 0 and d > 0:
        total += b * d * moments[_place(a + c, b + d - 2)]
    return total
