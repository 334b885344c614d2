"""Curvatures of a second fundamental form, a parametrisation, a graph, or K and H alone.

Every function here keeps k1 >= k2, k1 k2 = K and k1 + k2 = 2 H, and turns (d1, d2, n) into a
right-handed frame. A surface that bends away from its normal has positive curvature: the unit
sphere with outward normals has K = H = k1 = k2 = +1.
"""

import math
from collections import namedtuple

import numpy as np

from .compiled import compiled
from .vectors import cross, divide, dot, norm

Curvatures = namedtuple("Curvatures", "K H k1 k2 d1 d2")
Curvatures.__doc__ = """Gaussian and mean curvature, principal curvatures and their directions.

At one point numbers and triples; of a batch of m arrays (m,) and, component first, (3, m). None
stands for a quantity that is not estimated.
"""

ERRORS = "K_error", "H_error", "k1_error", "k2_error"
Assessed = namedtuple("Assessed", (*Curvatures._fields, *ERRORS, "choice"))
Assessed.__doc__ = """Curvatures, standard errors of K, H, k1 and k2, None where not estimated, and
the Choice of the method."""

Choice = namedtuple("Choice", "calls index")
Choice.__doc__ = """What an estimator chose at each vertex.

Attributes
----------
calls : tuple of str
    Such as "jet(degree=6, rings=3)".
index : (V,) uint8
    Into `calls`.
"""

# Principal curvatures that differ by less than this part of the larger are equal: an umbilic.
UMBILIC = 1e-9


@compiled
def from_form(a, b, c, e1, n, flat=0.0):
    """Curvatures of a second fundamental form [[a, b], [b, c]].

    Parameters
    ----------
    a, b, c : float
        The form in the orthonormal frame (e1, n x e1), in 1/length.
    e1, n : tuple of 3 floats
        Unit tangent and unit normal.
    flat : float
        Curvature below which the surface is flat, at most 1/size of the surface; it takes part in
        the test for an umbilic.

    Returns
    -------
    Curvatures
        Of the point. d1 and d2 are NaN at an umbilic, |k1 - k2| <= UMBILIC max(|k1|, |k2|, flat).
    """
    H, half = (a + c) / 2, (a - c) / 2
    gap = math.sqrt(half * half + b * b)
    k1, k2 = H + gap, H - gap
    # (half + gap, b) and (b, gap - half) both point along k1; the longer one does not cancel.
    x, y = (b, gap - half) if half < 0 else (half + gap, b)
    length = math.sqrt(x * x + y * y)
    if not gap > UMBILIC * max(abs(k1), abs(k2), flat):
        length = math.nan
    e2 = cross(n, e1)
    d1 = divide((x * e1[0] + y * e2[0], x * e1[1] + y * e2[1], x * e1[2] + y * e2[2]), length)
    return Curvatures(a * c - b * b, H, k1, k2, d1, cross(n, d1))


@compiled
def from_derivatives(S_u, S_v, S_uu, S_uv, S_vv, flat=0.0):
    """Curvatures of a parametrised surface S(u, v), and its unit normal along S_u x S_v.

    Parameters
    ----------
    S_u, S_v, S_uu, S_uv, S_vv : tuple of 3 floats
        Derivatives at the point.
    flat : float
        As in `from_form`.

    Returns
    -------
    Curvatures, tuple of 3 floats
        All NaN where S_u and S_v are parallel to 1e-13.

    Notes
    -----
    The form is taken in the orthonormal frame S_u / |S_u|, n x S_u / |S_u|, where k1 - k2 is a
    square root of squares: no cancellation near umbilics. Source: do Carmo (1976), section 3.3.
    """
    n = cross(S_u, S_v)
    area, p = norm(n), norm(S_u)
    n = divide(n, area if area > 1e-13 * p * norm(S_v) else math.nan)
    q, r = dot(S_u, S_v) / p, area / p
    L, M, N = -dot(S_uu, n), -dot(S_uv, n), -dot(S_vv, n)
    a = L / (p * p)
    b = (M / p - q * a) / r
    c = (N - q * q * a - 2 * q * r * b) / (r * r)
    return from_form(a, b, c, divide(S_u, p), n, flat), n


@compiled
def from_graph(p, q, r, s, t, X, Y, N):
    """Curvatures of a height field z = f(x, y), z along N, and its unit normal on the side of N.

    Parameters
    ----------
    p, q, r, s, t : float
        f_x, f_y, f_xx, f_xy and f_yy at the point.
    X, Y, N : tuple of 3 floats
        The right-handed orthonormal frame of x, y and z.

    Returns
    -------
    Curvatures, tuple of 3 floats
    """
    # The frame is S_u / |S_u| and its turn by a right angle; g is |S_u x S_v|.
    u = np.sqrt(1 + p * p)
    g = np.sqrt(1 + p * p + q * q)
    over_u, over_g = 1 / u, 1 / g
    n = (
        (N[0] - p * X[0] - q * Y[0]) * over_g,
        (N[1] - p * X[1] - q * Y[1]) * over_g,
        (N[2] - p * X[2] - q * Y[2]) * over_g,
    )
    e1 = (X[0] + p * N[0]) * over_u, (X[1] + p * N[1]) * over_u, (X[2] + p * N[2]) * over_u
    slope, over_height = p * q * over_u, u * over_g
    a = -r * over_g * over_u * over_u
    b = (-s * over_g * over_u - slope * a) * over_height
    c = (-t * over_g - slope * slope * a) * over_height * over_height
    c -= 2 * slope * b * over_height
    return from_form(a, b, c, e1, n), n


@compiled
def batch(m):
    """Curvatures of m points, uninitialised, to be set by `put`.

    Parameters
    ----------
    m : int

    Returns
    -------
    Curvatures
        Arrays (m,); d1 and d2 (3, m).
    """
    return Curvatures(
        np.empty(m), np.empty(m), np.empty(m), np.empty(m), np.empty((3, m)), np.empty((3, m))
    )


@compiled
def put(curvatures, k, point):
    """Write the Curvatures of a point to index k of a batch.

    Parameters
    ----------
    curvatures : Curvatures
        From `batch`; written to.
    k : int
    point : Curvatures
        Of one point.
    """
    curvatures.K[k], curvatures.H[k] = point.K, point.H
    curvatures.k1[k], curvatures.k2[k] = point.k1, point.k2
    for i in range(3):
        curvatures.d1[i, k], curvatures.d2[i, k] = point.d1[i], point.d2[i]


def principal_values(K, H):
    """k1 >= k2 with k1 k2 = K and k1 + k2 = 2 H, from K and H alone.

    Parameters
    ----------
    K, H : array_like, (m,)
        In 1/length^2 and 1/length.

    Returns
    -------
    k1, k2 : ndarray, (m,)
        In 1/length. NaN where H^2 < K by more than rounding: no surface has such values, but an
        estimator that does not take K and H from one tensor may return them.

    Examples
    --------
    >>> k1, k2 = principal_values([1.0, -1.0, 2.0], [1.0, 0.0, 1.0])
    >>> k1, k2
    (array([ 1.,  1., nan]), array([ 1., -1., nan]))
    """
    K, H = np.asarray(K, float), np.asarray(H, float)
    gap = H * H - K
    rounding = 8 * np.finfo(float).eps * np.maximum(H * H, np.abs(K))
    with np.errstate(invalid="ignore", divide="ignore"):
        # The larger root does not cancel; the smaller one follows from the product.
        larger = H + np.copysign(np.sqrt(np.where(np.abs(gap) <= rounding, 0, gap)), H)
        smaller = np.where(larger == 0, 0, K / larger)
    return np.maximum(larger, smaller), np.minimum(larger, smaller)
