"""Normals of all vertices as unknowns: polynomials fitted to heights and slopes nearby."""

from typing import Literal

import numpy as np

from curvlib.kit.compiled import kernel
from curvlib.kit.coupled import Coupled
from curvlib.kit.hermite import fit_hermite
from curvlib.kit.tensor import from_graph
from curvlib.kit.vectors import tangents
from curvlib.kit.wider import wider

from .jet import fit_jet

LABEL = "Compact Hermite"
SOURCE = "https://doi.org/10.1016/0021-9991(92)90324-R"
STYLE = {"color": "#117733", "marker": "D", "linestyle": "-"}
GLOBAL = "the normals of all vertices are solved together"
PRECISION = 1e-7  # on coarse meshes: equations are stored in single precision

# Weight of slopes beside heights: 0.1 has errors 1.1 to 1.3 times as large at degree 6, 0.5 more
# than twice. The smallest sine as in `fit_polynomial`; the largest gain.
SLOPE, SINE, GAIN = 0.03, 1e-5, 0.7
# The largest change of the last sweep and the largest square of a slope, of 18 degrees.
UNSETTLED, STEEP = 0.01, 0.1


@kernel
def estimate(disk, fitted, degree: Literal[6, 4, 5] = 6):
    """All of K, H, k1, k2, d1 and d2 of a polynomial z = f(x, y) through the vertex, fitted by
    least squares to the heights of its neighbours and to the slopes of their normals, which are
    those of their own polynomials: a linear system over all vertices.

    Parameters
    ----------
    disk : Disk
        A vertex and its neighbours.
    fitted : (9, 1 + n)
        The derivatives of f at the vertices, the normals that z is along, and by how much slopes
        changed in the last sweep.
    degree : {6, 4, 5}
        Of the polynomial; with 6 and 5 over two rings of neighbours, with 4 over one.

    Returns
    -------
    Curvatures
        Pointwise, in 1/length^2 and 1/length, positive where the surface bends away from its
        normal; d1 and d2 are NaN at an umbilic. NaN: needs a disk or half-disk of triangles, whose
        vertices determine a jet of degree 2. Vertices on a boundary have values.

    Notes
    -----
    Scheme. At first the normal N of each vertex is that of a jet of degree 3 over 2 rings, on the
    boundary of degree 6 over 3. In the frame of N neighbour j has the height z_j and the slopes
    -(N_j . X) / (N_j . N), -(N_j . Y) / (N_j . N). Residuals of heights have the weight 1, those of
    slopes 0.03, in coordinates in which the second moments of the neighbours are half the identity.
    So slopes decide only what heights leave open: 18 neighbours have 54 residuals for the 27
    coefficients of degree 6, 6 neighbours 18 for the 14 of degree 4.

    The slopes of f at the vertex are linear in the changes of the normals of its neighbours, to the
    second order of these, which are O(h^3). The system is solved by sweeps, each from the slopes of
    the last, until a sweep changes them by less than 1e-3 of the first, at most 16: 5 to 7 at
    degree 6, 4 or 5 at 5, 10 to 12 at 4. The spectral radius of a sweep was 0.25, 0.2 and 0.6 on
    jittered meshes, 0.25 to 0.5, 0.35 and 0.6 on random points; nearly all eigenvalues are real. It
    is not proven to be below 1.

    Guards. Where a neighbour lies on the boundary or has no normal, and where neither these rings
    nor one ring more determine the polynomial with a Frobenius norm of at most 0.7 of the map from
    changes of their normals to that of the vertex, a vertex takes the jet of the same degree over 3
    rings, at degree 4 over 2, whose slopes depend on no others. So do the boundary and the two
    layers behind it, at degree 4 one; no other vertex of jittered or random meshes of 10,000
    vertices did. Where the last sweep changes a slope by 0.01 or more, or where f turns the first
    normal by more than 18 degrees, as on meshes that are too coarse for their surface, values are
    those of the jet of degree 4 over 2 rings.

    On noise its errors of K are 1.5 to 1.7 times those of the jet of degree 6 over 3 rings, and 4
    times those of degree 4 over 3. It is the best for vertices that are exact to 1e-5 of an edge.
    Stencils are compact, the reach is not: behind a crease errors fall by 3 to 4 from edge to edge,
    unless the mesh is cut there (`creases` of `curvlib.estimate`).

    Memory: 0.9 kB a vertex at degree 6 and 5, 0.5 kB at 4.

    Order: O(h^(degree - 1)), measured on jittered and random meshes, closed and open; not proven.

    Source: Lele (1992), Compact finite difference schemes with spectral-like resolution, for the
    scheme on grids; Jiao, Zha (2008), Consistent computation of first- and second-order
    differential quantities for surface meshes, for fits to slopes that were fitted before.
    """
    N = fitted[5, 0], fitted[6, 0], fitted[7, 0]
    X, Y = tangents(N)
    f = fitted[0, 0], fitted[1, 0], fitted[2, 0], fitted[3, 0], fitted[4, 0]
    flat = f[0] * f[0] + f[1] * f[1] < STEEP
    if not (flat and fitted[8, 0] < UNSETTLED and f[2] == f[2]):
        N = disk.normal
        X, Y = tangents(N)
        f, _, _ = fit_jet(disk, X, Y, N, 4, 2, True)
    return from_graph(*f, X, Y, N)[0]


@kernel
def fitted(disk, normals, degree: Literal[6, 4, 5] = 6) -> Coupled:
    """The polynomial of a vertex as a function of the normals of its neighbours.

    Parameters
    ----------
    disk : Disk
    normals : (4, 1 + n)
        The first normals, and where they may change.
    degree : {6, 4, 5}

    Returns
    -------
    Coupled
        The unknowns are the slopes in the frame of the first normal, tangents(N).
    """
    N = normals[0, 0], normals[1, 0], normals[2, 0]
    X, Y = tangents(N)
    if degree > 4:
        disk, normals = wider(disk)
    inside = True
    for more in range(2):
        if more:
            disk, normals = wider(disk)
        for i in range(1 + disk.count):
            inside = inside and normals[3, i] == 1
        if not inside:
            break
        f, gain, derivatives = fit_hermite(disk, normals, X, Y, N, degree, SLOPE, SINE)
        if gain <= GAIN:
            return Coupled((f[0], f[1]), (f[2], f[3], f[4]), N, derivatives, disk.count)
    f, _, _ = fit_jet(disk, X, Y, N, degree, 2 if degree == 4 else 3, True)
    if not f[0] * f[0] + f[1] * f[1] < STEEP:
        return Coupled((0.0, 0.0), (np.nan, np.nan, np.nan), N, disk.rows, 0)
    return Coupled((f[0], f[1]), (f[2], f[3], f[4]), N, disk.rows, 0)


@kernel
def normals(disk, rings: Literal[2] = 2):
    """The first normal of a vertex, and 1 where its triangles close to one ring.

    Parameters
    ----------
    disk : Disk
    rings : {2}

    Returns
    -------
    x, y, z, closed : float
    """
    N = disk.normal
    X, Y = tangents(N)
    f, _, _ = fit_jet(disk, X, Y, N, 3 if disk.closed else 6, rings if disk.closed else 3, True)
    if f[0] == f[0]:
        N = from_graph(*f, X, Y, N)[1]
    return N[0], N[1], N[2], 1.0 if disk.closed and N[0] == N[0] else 0.0
