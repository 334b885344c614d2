"""The normal of a one-ring, and its neighbours seen in the tangent plane."""

import math
from typing import Literal

import numpy as np

from curvlib.errors import InputError

from .compiled import compiled
from .ring import FLAT, SHEET, total
from .vectors import add, at, divide, dot, norm

Normal = Literal["uniform", "area", "exact"]


@compiled
def unit_normal(ring, kind):
    """The unit normal N_v of each ring (3.3).

    Parameters
    ----------
    ring : Ring
    kind : {"uniform", "area", "exact"}
        Mean of the facets' unit normals, mean weighted by area, or `ring.exact_normals`.

    Returns
    -------
    (3, m)
        NaN where the facet normals cancel: their sum is shorter than SHEET times the sum of their
        lengths.

    Raises
    ------
    InputError
        "exact", and the mesh has no normals.
    """
    facets, areas = ring.facets, ring.areas
    n, m = areas.shape
    if kind == "exact":
        if ring.exact_normals.shape[1] != m:
            raise InputError("normal='exact' needs a mesh with normals; this one has none")
        return ring.exact_normals
    N = np.empty((3, m))
    for c in range(3):
        for k in range(m):
            N[c, k] = 0.0
    by_area = kind == "area"
    for i in range(n):
        for k in range(m):
            weight = 1.0 if by_area else 1 / areas[i, k]
            N[0, k], N[1, k], N[2, k] = add(at(N, k), weight, at(facets, i, k))
    # |e_i x e_{i+1}| is twice the area.
    sums = total(areas) if by_area else np.empty(m)
    for k in range(m):
        length = norm(at(N, k))
        longest = 2 * sums[k] if by_area else 2.0 * n
        length = length if length > SHEET * longest else np.nan
        N[0, k], N[1, k], N[2, k] = divide(at(N, k), length)
    return N


@compiled
def canonical(ring, N):
    """The canonical form: the neighbours with v at the origin and -N_v along the z axis.

    Parameters
    ----------
    ring : Ring
    N : (3, m)
        Unit normals.

    Returns
    -------
    (3, n, m)
        x, y, z of each v_i. z is the depth below the tangent plane, so that a surface that bends
        away from its normal has positive curvature: the paper's form, turned over. (x, y) is a
        multiple of T_i (3.23).
    """
    e = ring.e
    _, n, m = e.shape
    X, Y = _tangents(N)
    out = np.empty((3, n, m))
    for i in range(n):
        for k in range(m):
            edge = at(e, i, k)
            out[0, i, k] = dot(edge, at(X, k))
            out[1, i, k] = dot(edge, at(Y, k))
            out[2, i, k] = -dot(edge, at(N, k))
    return out


@compiled
def kn(ring, N):
    """Normal curvature towards each v_i, kn_i = -2 e_i . N / |e_i|^2 (3.16).

    Parameters
    ----------
    ring : Ring
    N : (3, m)
        Unit normals.

    Returns
    -------
    (n, m)
        In 1/length, positive where the surface bends away from its normal.
    """
    e, squares = ring.e, ring.squares
    n, m = squares.shape
    out = np.empty((n, m))
    for i in range(n):
        for k in range(m):
            out[i, k] = -2 * dot(at(e, i, k), at(N, k)) / squares[i, k]
    return out


@compiled
def whitening(xyz):
    """The map u = p x, v = q x + r y that whitens each ring: sum u_i^2 = sum v_i^2 = 1 and
    sum u_i v_i = 0.

    Parameters
    ----------
    xyz : (3, n, m)
        Neighbours in the canonical form.

    Returns
    -------
    p, q, r : (m,)
        In 1/length. Whitened coordinates of two frames differ by a rotation. r is NaN where the
        ring's projection is a line to FLAT.
    """
    _, n, m = xyz.shape
    p, q, r = np.empty(m), np.empty(m), np.empty(m)
    for k in range(m):
        xx = xy = yy = rest = 0.0
        for i in range(n):
            x, y = xyz[0, i, k], xyz[1, i, k]
            xx, xy, yy = xx + x * x, xy + x * y, yy + y * y
        # Summed over the remainders: yy - xy^2 / xx cancels.
        slope = xy / xx
        for i in range(n):
            remainder = xyz[1, i, k] - slope * xyz[0, i, k]
            rest += remainder * remainder
        line = not xx / (xx + yy) * (rest / (xx + yy)) > FLAT**2
        p[k], r[k] = 1 / np.sqrt(xx), np.nan if line else 1 / np.sqrt(rest)
        q[k] = -slope * r[k]
    return p, q, r


@compiled
def _tangents(N):
    """X and Y (3, m) of a right-handed orthonormal frame (X, Y, N).

    Source: Duff et al. (2017), Building an orthonormal basis, revisited (JCGT 6, 1).
    """
    X, Y = np.empty(N.shape), np.empty(N.shape)
    for k in range(N.shape[1]):
        x, y, z = at(N, k)
        sign = math.copysign(1.0, z)
        a = -1 / (sign + z)
        b = x * y * a
        X[0, k], X[1, k], X[2, k] = 1 + sign * x * x * a, sign * b, -sign * x
        Y[0, k], Y[1, k], Y[2, k] = b, sign + y * y * a, -y
    return X, Y
