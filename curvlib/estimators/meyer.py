"""Angle deficit and cotangent Laplacian over mixed Voronoi cells."""

import math

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.fit import CUTOFF
from curvlib.kit.frame import kn, unit_normal
from curvlib.kit.ring import mixed_area, total_angle, with_preceding, zeros
from curvlib.kit.tensor import Curvatures, from_form, principal_values
from curvlib.kit.vectors import add, at, dot, norm, tangents

LABEL = "Meyer et al."
SOURCE = "https://doi.org/10.1007/978-3-662-05105-4_2"
STYLE = {"color": "#56B4E9", "marker": "s", "linestyle": "-"}


def estimate(ring):
    """K = (2 pi - sum alpha_i) / A, |H| = |sum w_i e_i| / (4 A), k1 and k2 = H +- sqrt(H^2 - K),
    d1 and d2 of normal curvatures kn_i fitted in the tangent plane. A is the mixed area of v, w_i
    the sum of the cotangents of the two angles opposite e_i.

    Parameters
    ----------
    ring : Ring
        Batch of m closed one-rings of one valence n.

    Returns
    -------
    Curvatures
        Pointwise, in 1/length^2 and 1/length; H has the sign of -N . sum w_i e_i, N being the mean
        of the facet normals weighted by area, so that H > 0 where the surface bends away from its
        normal. NaN: needs a closed one-ring; so vertices on a boundary have no values. d1 and d2
        are NaN at an umbilic too, and where the fit does not determine them.

    Notes
    -----
    Where H^2 < K, k1 = k2 = H, as in the paper; elsewhere k1 k2 = K. d1 is the axis of the larger
    value of the form B of trace 2 H that minimises sum a_i (kn_i - B(t_i, t_i))^2, t_i being the
    direction of e_i in the tangent plane of N and a_i the area of the two triangles at e_i: the fit
    of section 5.3 with the constraint on the trace. The one on the determinant would change the
    values of B, which are not used. If all t_i lie along two perpendicular lines, they determine no
    axis. With a_i = w_i |e_i|^2, the weights of section 5.2, a rectangular grid would determine
    none, since the diagonals of rectangles have w_i = 0, and obtuse triangles make w_i negative.
    The paper takes the direction of sum w_i e_i for N, which is arbitrary where H is small.

    Order: none proven for pointwise values. Measured on shrinking rings: O(h^2) at valence 6 where
    e_i + e_{i+2} = e_{i+1}, as on a grid cut along one diagonal; on other rings the errors of K and
    H do not vanish.

    Source: Meyer, Desbrun, Schroeder, Barr (2003), Discrete differential-geometry operators for
    triangulated 2-manifolds, sections 3.3 to 5.3.
    """
    N, A = unit_normal(ring, "area"), mixed_area(ring)
    K = (2 * np.pi - total_angle(ring)) / A
    H = _half(ring.e, opposite_cotangents(ring), A, N)
    k1, k2 = principal_values(np.minimum(K, H * H), H)
    return Curvatures(K, H, k1, k2, *_directions(ring, N, H, k1, k2))


@compiled
def opposite_cotangents(ring):
    """The sum of the cotangents of the two angles opposite e_i, (n, m), of the Ring `ring`."""
    squares, dots, areas = ring.squares, ring.dots, ring.areas
    n, m = areas.shape
    out = np.empty((n, m))
    for i in range(n):
        j = (i + 1) % n
        for k in range(m):
            before = (squares[i - 1, k] - dots[i - 1, k]) / areas[i - 1, k]
            out[i, k] = (before + (squares[j, k] - dots[i, k]) / areas[i, k]) / 2
    return out


@compiled
def _half(e, weights, A, N):
    """|sum w_i e_i| / (4 A), (m,), positive where the sum points against N."""
    n, m = weights.shape
    H = np.empty(m)
    for k in range(m):
        total = (0.0, 0.0, 0.0)
        for i in range(n):
            total = add(total, weights[i, k], at(e, i, k))
        H[k] = math.copysign(norm(total), -dot(total, at(N, k))) / (4 * A[k])
    return H


@compiled
def _directions(ring, N, H, k1, k2):
    """d1 and d2 (3, m) of the form with trace 2 H and values k1 and k2 along the fitted axes."""
    e, areas, curvature = ring.e, with_preceding(ring.areas), kn(ring, N)
    n, m = areas.shape
    d1, d2 = np.empty((3, m)), np.empty((3, m))
    cc, cs, ss, cr, sr = zeros(m), zeros(m), zeros(m), zeros(m), zeros(m)
    for k in range(m):
        X, Y = tangents(at(N, k))
        for i in range(n):
            # B(t, t) = H + p cos 2 phi + q sin 2 phi, phi being the angle from X to t.
            x, y = dot(at(e, i, k), X), dot(at(e, i, k), Y)
            xx, yy = x * x, y * y
            cosine, sine = (xx - yy) / (xx + yy), 2 * x * y / (xx + yy)
            a, rest = areas[i, k], curvature[i, k] - H[k]
            cc[k] += a * cosine * cosine
            cs[k] += a * cosine * sine
            ss[k] += a * sine * sine
            cr[k] += a * cosine * rest
            sr[k] += a * sine * rest
    for k in range(m):
        determinant = cc[k] * ss[k] - cs[k] * cs[k]
        proper = determinant > (CUTOFF * (cc[k] + ss[k])) ** 2
        p, q = ss[k] * cr[k] - cs[k] * sr[k], cc[k] * sr[k] - cs[k] * cr[k]
        scale = (k1[k] - k2[k]) / 2 / np.sqrt(p * p + q * q) if proper else np.nan
        X, _ = tangents(at(N, k))
        point = from_form(H[k] + scale * p, scale * q, H[k] - scale * p, X, at(N, k))
        d1[0, k], d1[1, k], d1[2, k] = point.d1
        d2[0, k], d2[1, k], d2[2, k] = point.d2
    return d1, d2
