"""Corrected curvature measures: triangles with better normals than their own, over one ring or a
ball."""

import math
from typing import Literal

from curvlib.kit.compiled import kernel
from curvlib.kit.disk import given_normal
from curvlib.kit.measures import corrected_measures
from curvlib.kit.options import Length
from curvlib.kit.polynomial import fit_polynomial
from curvlib.kit.tensor import Curvatures, from_form, from_graph
from curvlib.kit.vectors import add, at, divide, dot, norm, tangents

LABEL = "Corrected measures"
SOURCE = "https://doi.org/10.1111/cgf.14067"
STYLE = {"color": "#44AA99", "marker": "D", "linestyle": "-"}


@kernel
def facets(disk):
    """The normal of the triangles of `disk`, as long as a third of their area."""
    N = disk.normal
    return disk.area * N[0], disk.area * N[1], disk.area * N[2]


@kernel
def u(
    disk,
    facets,
    normals: Literal["area", "fit", "ball", "given"] = "area",
    rings: Literal[2] = 2,
    radius: Length = None,
):
    """The unit normal of the vertex of `disk` by the option `normals`, from `facets` (3, 1 + n) of
    the neighbours within two `rings`, or within `radius`."""
    N = disk.normal
    if normals == "given":
        N = given_normal(disk)
    if normals == "fit":
        X, Y = tangents(N)
        derivatives, degree = fit_polynomial(disk, X, Y, N, 0, 3)
        if degree > 1:
            N = from_graph(*derivatives, X, Y, N)[1]
    if normals == "ball":
        total, R = at(facets, 0), radius if radius < math.inf else disk.radius
        for i in range(disk.count):
            e, facet = at(disk.e, i), at(facets, 1 + i)
            if facet[0] == facet[0]:
                total = add(total, 1 - dot(e, e) / (R * R), facet)
        N = divide(total, norm(total))
    return N


@kernel
def estimate(
    ball,
    u,
    normals: Literal["area", "fit", "ball", "given"] = "area",
    radius: Length = None,
):
    """K = mu2 / mu0 and H = mu1 / 2 mu0 of the sums over a ball of the corrected measures of its
    triangles (`curvlib.kit.measures`), each times the part of its area inside; k1, k2 = H +-
    sqrt(H^2 - K). d1 and d2 are those of the tensor muXY, made symmetric, in the plane normal to u.

    Parameters
    ----------
    ball : Ball
        The triangles near a vertex.
    u : (3, p)
        Unit normals at their corners, by the function `u`.
    normals : {"area", "fit", "ball", "given"}
        "area": the mean normal of the triangles at each vertex, weighted by area. "fit": that of a
        cubic fitted by least squares to two rings of neighbours, or to those within `radius`.
        "ball": the mean of "area" over the same neighbours, weighted by cell times
        1 - distance^2 / radius^2 (without `radius`, that of the farthest). "given": the mesh's own.
    radius : length, optional
        Of the ball, which cuts triangles exactly. Without it, the triangles at the vertex.

    Returns
    -------
    Curvatures
        Pointwise, in 1/length^2 and 1/length, positive where the surface bends away from its
        normal; d1 and d2 are NaN at an umbilic of the tensor. NaN: needs a disk or half-disk of
        triangles, and a normal at the vertex. A triangle with a corner that has no normal is left
        out, one at a vertex without a disk or half-disk too. "fit" is "area" where neighbours
        determine no quadric. Vertices on a boundary have values.

    Raises
    ------
    InputError
        normals="given" and the mesh has none.

    Notes
    -----
    Near umbilics the measures may have K > H^2, as no surface has: there K = H^2 and k1 = k2 = H.
    The principal values of the tensor are not taken: the surface turns away from the plane normal
    to u, so that over a ball of four edges the tensor's H is up to six times as far off. Over one
    ring both differ little.

    Order: O(radius + e / radius), e being the error of the normals and not less than O(h^2) for
    exact vertices (Lachaud, Romon, Thibert 2022). With exact normals O(radius^2) is measured over
    a ball, so O(h) for a radius ~ sqrt(h), where "ball" has O(h), too, but for vertices near a
    boundary, and "area" h^0.7 to h; on a sphere values are exact. Over one ring O(h) with exact
    normals or "fit"; with "area" or "ball" the error does not vanish on irregular meshes.

    Source: Lachaud, Romon, Thibert, Coeurjolly (2020), Interpolated corrected curvature measures
    for polygonal surfaces.
    """
    N = at(u, 0)
    X, Y = tangents(N)
    area, bend, total = 0.0 if N[0] == N[0] else math.nan, 0.0, 0.0
    along_X, along_Y = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    points, triangles = ball.points, ball.triangles
    for t in range(triangles.shape[1]):
        i, j, k = triangles[0, t], triangles[1, t], triangles[2, t]
        mu0, mu1, mu2, muXY = corrected_measures(
            at(points, i), at(points, j), at(points, k), at(u, i), at(u, j), at(u, k)
        )
        if mu0 == mu0:
            part = ball.inside[t]
            area, bend, total = area + part * mu0, bend + part * mu1, total + part * mu2
            along_X = add(along_X, part, _row_times(X, muXY))
            along_Y = add(along_Y, part, _row_times(Y, muXY))
    a, c = -dot(along_X, X) / area, -dot(along_Y, Y) / area
    b = -(dot(along_X, Y) + dot(along_Y, X)) / (2 * area)
    tensor, H = from_form(a, b, c, X, N), bend / (2 * area)
    K = min(total / area, H * H)
    gap = math.sqrt(H * H - K)
    return Curvatures(K, H, H + gap, H - gap, tensor.d1, tensor.d2)


@kernel
def _row_times(x, rows):
    """x^t times the matrix of three rows."""
    a, b, c = rows
    return add(add((x[0] * a[0], x[0] * a[1], x[0] * a[2]), x[1], b), x[2], c)
