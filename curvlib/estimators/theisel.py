"""The derivative of normals interpolated in triangles, averaged over the one-ring."""

import numpy as np

from curvlib.kit.compiled import kernel
from curvlib.kit.disk import normals as normals
from curvlib.kit.tensor import from_form
from curvlib.kit.vectors import at, dot, tangents

LABEL = "Theisel et al."
SOURCE = "https://doi.org/10.1109/PCCGA.2004.1348359"
STYLE = {"color": "#44AA99", "marker": "^", "linestyle": "--"}


@kernel
def estimate(ball, normals):
    """All of K, H, k1, k2, d1 and d2 of the mean of the tensors S of the triangles at the vertex:
    S e = dN for the two edges e from the vertex, dN being the difference of the normals at their
    ends, both projected to the tangent plane of the vertex.

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
        normal at the vertex, whose projections with normals at all corners have an area of more
        than 0 in sum. Vertices on a boundary have values.

    Notes
    -----
    Position and normal are linear in a triangle. The tensor of the surface that they define, at the
    corner with normal N, has K = det(N_u, N_v, N) / det(x_u, x_v, N) and H = (det(N_u, x_v, N) +
    det(x_u, N_v, N)) / (2 det(x_u, x_v, N)); those are determinant and half the trace of S. Its
    weight is the area of the projected triangle: then the mean divides by no area of a single
    triangle, and in a closed ring the normal of the vertex enters by its plane alone. The paper
    leaves the weights open. S need not be symmetric; the symmetric part of the mean is taken.

    Order: O(h) on any mesh with exact normals. The normals of triangles are O(h) off on irregular
    meshes, where the error does not vanish. Measured on grids cut along one diagonal: O(h^2).

    Source: Theisel, Rossl, Zayer, Seidel (2004), Normal based estimation of the curvature tensor
    for triangular meshes.
    """
    N = at(normals, 0)
    X, Y = tangents(N)
    a, b, c, area = 0.0, 0.0, 0.0, 0.0
    for t in range(ball.triangles.shape[1]):
        i, j = ball.triangles[1, t], ball.triangles[2, t]
        e, f = at(ball.points, i), at(ball.points, j)
        x, y, u, v = dot(e, X), dot(e, Y), dot(f, X), dot(f, Y)
        M, L = at(normals, i), at(normals, j)
        p, q, r, s = dot(M, X), dot(M, Y), dot(L, X), dot(L, Y)
        if p + r == p + r:
            a += p * v - r * y
            b += (q * v - s * y + r * x - p * u) / 2
            c += s * x - q * u
            area += x * v - y * u
    area = area if area > 0 else np.nan
    return from_form(a / area, b / area, c / area, X, N)
