"""Normal vector voting: neighbours within a length along edges vote twice, for the normal and for
the tensor of curvature.

All weights decay with the distance g along edges as exp(-g / sigma), 3 sigma = radius.
"""

from typing import Literal

import numpy as np

from curvlib.kit import lanes
from curvlib.kit.compiled import kernel
from curvlib.kit.fit import CUTOFF
from curvlib.kit.options import Geodesic
from curvlib.kit.ring import ROUNDING
from curvlib.kit.tensor import from_form
from curvlib.kit.vectors import cross, divide, dot, norm, tangents

LABEL = "Tensor voting"
SOURCE = "https://doi.org/10.1371/journal.pcbi.1007962"
STYLE = {"color": "#AA4499", "marker": "D", "linestyle": "-"}
PER = ("vertex", "face")

# Rows of a Disk: e and a row of ones. Then of the votes for a normal n and w n; of those for
# curvature x, y in the tangent plane, the weight w, w kappa, cos 2 theta, sin 2 theta, w cos.
E, ONE = 0, 3
NORMAL, WEIGHED = 4, 7
X, Y, W, WK, C, S, WC = 4, 5, 6, 7, 8, 9, 10
# A neighbour so steep that its distance in the tangent plane is 1e-6 of that in space has no
# direction there.
STEEP = 1e-12
# Squarings of a matrix after which eigenvalues that differ by 1e-11 of the largest are told apart.
SQUARINGS = 42


@kernel
def facets(disk):
    """What votes: the normal of a disk and its area."""
    return *disk.normal, disk.area


@kernel
def voted(disk, facets, radius: Geodesic = "5 edges"):
    """The first pass: the normal that the neighbours vote for, and the area again.

    A vote is the neighbour's normal n, carried along the arc of a circle from the neighbour to the
    vertex: n - 2 (n . e) e / |e|^2. The voted normal is the eigenvector of the largest eigenvalue
    of the sum of area exp(-g / sigma) n n^T, on the side of the vertex's own normal.

    Parameters
    ----------
    disk : Disk
    facets : (4, 1 + n)
        Normals and areas.
    radius : length
        Along edges.

    Returns
    -------
    tuple of 4 floats
        The normal is NaN where there are no votes, or where they prefer none.
    """
    e, rows, shortest = disk.e, disk.rows, (ROUNDING * disk.radius) ** 2
    for k in range(len(disk.weights)):
        x, y, z = e[0, k], e[1, k], e[2, k]
        a, b, c = facets[0, 1 + k], facets[1, 1 + k], facets[2, 1 + k]
        turn = 2 * (a * x + b * y + c * z) / (x * x + y * y + z * z)
        w = facets[3, 1 + k] * _decay(disk.distances[k] / radius)
        # Neither padding nor a neighbour without a normal, or at a distance of rounding.
        votes = (turn == turn) & (x * x + y * y + z * z > shortest)
        a, b, c = (a if votes else 0.0), (b if votes else 0.0), (c if votes else 0.0)
        w, turn = (w if votes else 0.0), (turn if votes else 0.0)
        a, b, c = a - turn * x, b - turn * y, c - turn * z
        rows[NORMAL, k], rows[NORMAL + 1, k], rows[NORMAL + 2, k] = a, b, c
        rows[WEIGHED, k], rows[WEIGHED + 1, k], rows[WEIGHED + 2, k] = w * a, w * b, w * c
    n = _dominant(
        lanes.dot(rows, NORMAL, WEIGHED),
        lanes.dot(rows, NORMAL, WEIGHED + 1),
        lanes.dot(rows, NORMAL, WEIGHED + 2),
        lanes.dot(rows, NORMAL + 1, WEIGHED + 1),
        lanes.dot(rows, NORMAL + 1, WEIGHED + 2),
        lanes.dot(rows, NORMAL + 2, WEIGHED + 2),
    )
    side = dot(n, disk.normal)
    return *divide(n, side / abs(side)), facets[3, 0]


@kernel
def estimate(
    disk,
    voted,
    radius: Geodesic = "5 edges",
    weights: Literal["area", "none"] = "area",
    directions: Literal["uniform", "fitted"] = "uniform",
):
    """All of K, H, k1, k2, d1 and d2 by votes of the neighbours within a length along edges.

    A neighbour in the tangent direction t votes for the normal curvature kappa = 2 sin(phi / 2) /
    |e| there, phi being the angle between the voted normals, the neighbour's projected into the
    plane of t and the vertex's: the curvature of the circle through both that has these normals.
    The eigenvalues b1 >= b2 of the weighted mean of kappa t t^T give k1 = 3 b1 - b2 and
    k2 = 3 b2 - b1.

    Parameters
    ----------
    disk : Disk
        A vertex or a triangle's centre, its neighbours and their distances along edges; between
        triangles, edges join the centres of those that share a vertex.
    voted : (4, 1 + n)
        Normals and areas of the first pass.
    radius : length
        Largest distance along edges. Salfer et al. give the radius r_h of a sphere on which it is
        a quarter of a great circle: radius = pi r_h / 2.
    weights : {"area", "none"}
        "area" (their AVV): votes weigh area exp(-g / sigma); "none" (RVV): for curvature without
        the area. They divide areas by the largest of the mesh, which cancels.
    directions : {"uniform", "fitted"}
        "uniform": k1 and k2 as above, right where all directions have the same weight. "fitted":
        kappa = H + p cos 2 theta + q sin 2 theta by weighted least squares, right for any weights.

    Returns
    -------
    Curvatures
        Pointwise, in 1/length^2 and 1/length, positive where the surface bends away from its
        normal; d1 and d2 are NaN at an umbilic. NaN: needs a disk or half-disk of triangles whose
        normals do not cancel, and votes in three directions. Vertices on a boundary have values,
        by votes from inside, which tilt the normal: on a cylinder k2 there is off by k1 / 6.

    Notes
    -----
    Every vertex counts as part of a smooth surface: the parameters epsilon and eta, by which votes
    may be classed as a crease or as without orientation, are 0, as in the publication.

    Paths along edges are longer in some directions than in others, however fine the mesh, and so
    directions have different weights. With "uniform" that makes k1 - k2 wrong, most of all at the
    vertices of a grid with parallel diagonals (on a torus K by half of its mean size).

    Order: measured over five edges, with "fitted" directions on a regular mesh O(h) in the mean,
    since of opposite neighbours one may lie beyond the radius; on a torus of radii 2 and 1 H is off
    by 0.0094, 0.0023, 0.00094 and 0.00047 at 48^2, 96^2, 192^2 and 512^2 vertices. Else none: on an
    irregular torus of these radii with 9,216 and 36,864 vertices H is off by 0.031 and 0.030 in the
    mean, "fitted" by 0.0071 and 0.0057; per face by 0.0094 and 0.0086, "fitted" by 0.0047 and
    0.0023.

    Source: Page, Sun, Koschan, Paik, Abidi (2002), Normal vector voting; Tong, Tang (2005), Robust
    estimation of adaptive tensors of curvature by tensor voting; Salfer, Collado, Baumeister,
    Fernandez-Busnadiego, Martinez-Sanchez (2020), Reliable estimation of membrane curvature for
    cryo-electron tomography.
    """
    e, rows, N = disk.e, disk.rows, (voted[0, 0], voted[1, 0], voted[2, 0])
    t1, t2 = tangents(N)
    lanes.project(rows, X, E, t1)
    lanes.project(rows, Y, E, t2)
    by_area, shortest = weights == "area", (ROUNDING * disk.radius) ** 2
    for k in range(len(disk.weights)):
        x, y = rows[X, k], rows[Y, k]
        a, b, c = voted[0, 1 + k], voted[1, 1 + k], voted[2, 1 + k]
        square, flat = e[0, k] * e[0, k] + e[1, k] * e[1, k] + e[2, k] * e[2, k], x * x + y * y
        inverse = 1 / flat
        # The neighbour's normal along N; along t, times |(x, y)|; its length in their plane.
        up = a * N[0] + b * N[1] + c * N[2]
        out = (a * t1[0] + b * t1[1] + c * t1[2]) * x + (a * t2[0] + b * t2[1] + c * t2[2]) * y
        length = np.sqrt(up * up + out * out * inverse)
        # 2 sin(phi / 2) with its sign, without an angle and without cancellation.
        kappa = out * np.sqrt(2 * inverse / (length * (length + up) * square))
        w = _decay(disk.distances[k] / radius) * (voted[3, 1 + k] if by_area else 1.0)
        # Neither padding nor a neighbour without a normal, or a direction, or an angle phi < pi, or
        # at a distance of rounding.
        votes = (flat > STEEP * square) & (kappa - kappa == 0) & (square > shortest)
        w, kappa = (w if votes else 0.0), (kappa if votes else 0.0)
        inverse = inverse if votes else 0.0
        rows[W, k], rows[WK, k] = w, w * kappa
        rows[C, k], rows[S, k] = (x * x - y * y) * inverse, 2 * x * y * inverse
        rows[WC, k] = w * rows[C, k]
    # Normal equations for 1, cos 2 theta and sin 2 theta.
    total, c, s = lanes.dot(rows, W, ONE), lanes.dot(rows, W, C), lanes.dot(rows, W, S)
    cc, cs = lanes.dot(rows, WC, C), lanes.dot(rows, WC, S)
    A, B, D = (total, c, s), (c, cc, cs), (s, cs, total - cc)
    determined = dot(A, cross(B, D)) > CUTOFF**2 * total * total * total
    if directions == "uniform":
        A, B, D = (total, 0.0, 0.0), (0.0, total / 2, 0.0), (0.0, 0.0, total / 2)
    right = lanes.dot(rows, WK, ONE), lanes.dot(rows, WK, C), lanes.dot(rows, WK, S)
    across = divide(right, dot(A, cross(B, D)) if determined else np.nan)
    H, p, q = dot(across, cross(B, D)), dot(across, cross(D, A)), dot(across, cross(A, B))
    return from_form(H + p, q, H - p, t1, N)


@kernel
def _decay(x):
    """exp(-3 x), 0 <= x <= 1, to 1e-13: vectorised, and the same on every machine."""
    x *= -3 / 32
    y = 1 / 24 + x * (1 / 120 + x * (1 / 720 + x * (1 / 5040 + x * (1 / 40320))))
    y = 1 + x * (1 + x * (1 / 2 + x * (1 / 6 + x * y)))
    y *= y
    y *= y
    y *= y
    y *= y
    return y * y


@kernel
def _dominant(xx, xy, xz, yy, yz, zz):
    """The unit eigenvector of the largest eigenvalue of a positive semidefinite matrix: squared
    again and again, it tends to the projection on that vector. NaN where the matrix is zero, or
    the largest eigenvalue is not single."""
    for _ in range(SQUARINGS):
        inverse = 1 / (xx + yy + zz)
        xx, xy, xz = xx * inverse, xy * inverse, xz * inverse
        yy, yz, zz = yy * inverse, yz * inverse, zz * inverse
        # The sum of the products of two eigenvalues, whose own sum is 1.
        rest = (xx * yy - xy * xy) + (xx * zz - xz * xz) + (yy * zz - yz * yz)
        xx, xy, xz, yy, yz, zz = (
            xx * xx + xy * xy + xz * xz,
            xx * xy + xy * yy + xz * yz,
            xx * xz + xy * yz + xz * zz,
            xy * xy + yy * yy + yz * yz,
            xy * xz + yy * yz + yz * zz,
            xz * xz + yz * yz + zz * zz,
        )
        if rest < 1e-9:
            break
    else:
        return np.nan, np.nan, np.nan
    column = (xy, yy, yz) if yy > xx else (xx, xy, xz)
    column = (xz, yz, zz) if zz > max(xx, yy) else column
    return divide(column, norm(column))
