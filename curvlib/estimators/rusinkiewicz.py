"""Tensors of triangles by finite differences of vertex normals, averaged over the one-ring."""

import numpy as np

from curvlib.kit.compiled import kernel
from curvlib.kit.disk import normals as normals
from curvlib.kit.fit import CUTOFF
from curvlib.kit.tensor import from_form
from curvlib.kit.vectors import add, at, cross, divide, dot, norm, tangents

LABEL = "Rusinkiewicz"
SOURCE = "https://doi.org/10.1109/TDPVT.2004.1335277"
STYLE = {"color": "#44AA99", "marker": "v", "linestyle": "-"}


@kernel
def estimate(ball, normals):
    """All of K, H, k1, k2, d1 and d2 of the mean of the second fundamental forms B of the triangles
    at the vertex: B (e, t) = dN . t for the three edges e of a triangle, dN being the difference of
    the normals at its ends, and the tangents t of the triangle, by least squares.

    Parameters
    ----------
    ball : Ball
        A vertex and its triangles.
    normals : (3, p)
        Unit normals of the points, weighted by area.

    Returns
    -------
    Curvatures
        Pointwise, in 1/length^2 and 1/length, positive where the surface bends away from its
        normal; d1 and d2 are NaN at an umbilic. NaN: needs a disk or half-disk of triangles, with a
        normal at the vertex and at the corners of one triangle. Vertices on a boundary have values.

    Notes
    -----
    B is turned from the plane of its triangle to the tangent plane of the vertex by the rotation
    about their common line, and weighted by the part of the triangle in the mixed Voronoi cell of
    the vertex. Left out are triangles with a height below 0.001 of their longest edge, and those
    with a corner that has no normal.

    Order: O(h) on any mesh with exact normals. The normals of triangles are O(h) off on irregular
    meshes, where the error does not vanish. Measured on grids cut along one diagonal: O(h^2).

    Source: Rusinkiewicz (2004), Estimating curvatures and their derivatives on triangle meshes,
    section 3.
    """
    N = at(normals, 0)
    X, Y = tangents(N)
    a, b, c, area = 0.0, 0.0, 0.0, 0.0
    for t in range(ball.triangles.shape[1]):
        i, j = ball.triangles[1, t], ball.triangles[2, t]
        form, U, V, part = _of_triangle(
            at(ball.points, i), at(ball.points, j), N, at(normals, i), at(normals, j)
        )
        p, q, r = form
        if p + q + r == p + q + r:
            # The frame turned with the triangle, in that of the vertex.
            W = cross(U, V)
            turned = 1 + dot(W, N)
            U = add(add(U, -dot(U, N) / turned, W), -dot(U, N) / turned, N)
            V = add(add(V, -dot(V, N) / turned, W), -dot(V, N) / turned, N)
            x, y, u, v = dot(U, X), dot(U, Y), dot(V, X), dot(V, Y)
            a += part * (p * x * x + 2 * q * x * u + r * u * u)
            b += part * (p * x * y + q * (x * v + y * u) + r * u * v)
            c += part * (p * y * y + 2 * q * y * v + r * v * v)
            area += part
    area = area if area > 0 else np.nan
    return from_form(a / area, b / area, c / area, X, N)


@kernel
def _of_triangle(e, f, N, N_e, N_f):
    """The form ((p, q), (q, r)) of the triangle of the vertex, v + e and v + f; its frame; and the
    area of the part nearest to v."""
    facet, g = cross(e, f), add(f, -1.0, e)
    twice, ee, ff, gg = norm(facet), dot(e, e), dot(f, f), dot(g, g)
    U = divide(e, np.sqrt(ee))
    V = cross(divide(facet, twice), U)
    A, B, C, k, m, n = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for edge, change in ((e, add(N_e, -1.0, N)), (f, add(N_f, -1.0, N)), (g, add(N_f, -1.0, N_e))):
        u, v, du, dv = dot(edge, U), dot(edge, V), dot(change, U), dot(change, V)
        A, B, C = A + u * u, B + u * v, C + v * v
        k, m, n = k + u * du, m + u * dv + v * du, n + v * dv
    proper = twice > CUTOFF * max(ee, ff, gg)
    D = A + C
    determinant = D * (A * C - B * B) if proper else np.nan
    form = (
        (k * (D * C - B * B) - B * (m * C - n * B)) / determinant,
        (A * (m * C - n * B) - k * B * C) / determinant,
        (A * (D * n - B * m) - B * B * n + k * B * B) / determinant,
    )
    ef, eg, fg = dot(e, f), -dot(e, g), dot(f, g)
    part = (ee * fg + ff * eg) / (8 * twice)
    if ef < 0:
        part = twice / 4
    elif eg < 0 or fg < 0:
        part = twice / 8
    return form, U, V, part
