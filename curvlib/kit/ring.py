"""The one-ring of a vertex in the paper's letters: named quantities, as compiled functions.

A Ring is a batch of m one-rings of equal valence n. Arrays are component first, (3, n, m), and
the loop over the m rings is the inner one: it runs over contiguous memory, which the compiler
turns into vector instructions. The ring of v is v_0 ... v_{n-1}, counter-clockwise seen from the
side the normal points to; indices are taken mod n. Lengths are in the unit of the mesh, angles
in radians. A degenerate triangle gives NaN.
"""

import math
from collections import namedtuple
from typing import Literal

import numpy as np

from curvlib.errors import InputError

from .compiled import compiled
from .vectors import add, angle, at, cross, divide, dot, norm

Normal = Literal["uniform", "area", "exact"]

Ring = namedtuple("Ring", "e exact_normals squares lengths facets areas dots")
Ring.__doc__ = """m one-rings of valence n.

`e` (3, n, m): the edge vectors e_i = v_i - v. `exact_normals` (3, m): unit normals of the
surface, or (3, 0) where the mesh has none. `squares` (n, m): |e_i|^2. `lengths` (n, m): |e_i|.
`facets` (3, n, m): e_i x e_{i+1}, along the normal of T_i = (v_i, v, v_{i+1}) and twice its area
long. `areas` (n, m): the area of T_i (3.1). `dots` (n, m): e_i . e_{i+1}.
"""


@compiled
def one_ring(e, exact_normals):
    """The Ring of edge vectors (3, n, m) and normals (3, m) or (3, 0)."""
    _, n, m = e.shape
    squares, lengths, areas, dots = np.empty((4, n, m))
    facets = np.empty((3, n, m))
    for i in range(n):
        j = (i + 1) % n
        for k in range(m):
            a, b = at(e, i, k), at(e, j, k)
            c = cross(a, b)
            facets[0, i, k], facets[1, i, k], facets[2, i, k] = c
            squares[i, k] = dot(a, a)
            lengths[i, k] = norm(a)
            areas[i, k] = norm(c) / 2
            dots[i, k] = dot(a, b)
    return Ring(e, exact_normals, squares, lengths, facets, areas, dots)


@compiled
def around(vertices, normals, centres, neighbours, start, end):
    """The Ring of the vertices centres[start:end], whose neighbours are neighbours[:, start:end].

    `vertices` (V, 3), their `normals` (V, 3) or (0, 3) where the mesh has none.
    """
    n, m = len(neighbours), end - start
    e = np.empty((3, n, m))
    for i in range(n):
        for k in range(m):
            # Without a sign: no look for a negative index.
            v, v_i = np.uint64(centres[start + k]), np.uint64(neighbours[i, start + k])
            for c in range(3):
                e[c, i, k] = vertices[v_i, c] - vertices[v, c]
    exact_normals = np.empty((3, m if len(normals) else 0))
    for k in range(exact_normals.shape[1]):
        for c in range(3):
            exact_normals[c, k] = normals[centres[start + k], c]
    return one_ring(e, exact_normals)


@compiled
def spread(values, centres, start, target):
    """Write values (m,) to target[centres[start:start + m]]: the one place where what is undefined,
    infinite or not a number, becomes NaN."""
    for k in range(len(values)):
        target[centres[start + k]] = values[k] if math.isfinite(values[k]) else math.nan


@compiled
def total(x):
    """Sum over the ring, (m,), of (n, m)."""
    out = np.zeros(x.shape[1])
    for i in range(len(x)):
        for k in range(x.shape[1]):
            out[k] += x[i, k]
    return out


@compiled
def weighted_total(weights, x):
    """Sum over the ring, (m,), of the products of two (n, m)."""
    out = np.zeros(x.shape[1])
    for i in range(len(x)):
        for k in range(x.shape[1]):
            out[k] += weights[i, k] * x[i, k]
    return out


@compiled
def with_preceding(x):
    """x_{i-1} + x_i, (n, m): of triangles, the sum of the two that share e_i."""
    out = np.empty_like(x)
    for i in range(len(x)):
        for k in range(x.shape[1]):
            out[i, k] = x[i - 1, k] + x[i, k]
    return out


@compiled
def following(x):
    """x_{i+1} at i, (n, m)."""
    n = len(x)
    out = np.empty_like(x)
    for i in range(n):
        out[i] = x[(i + 1) % n]
    return out


@compiled
def alpha(ring):
    """alpha_i = angle(v_i, v, v_{i+1}) in [0, pi], (n, m)."""
    out = np.empty_like(ring.areas)
    for i in range(len(out)):
        for k in range(out.shape[1]):
            # arctan2(2 area, dot), in less time.
            out[i, k] = math.pi / 2 - math.atan(ring.dots[i, k] / (2 * ring.areas[i, k]))
    return out


@compiled
def total_angle(ring):
    """Sum of all alpha_i, (m,): the argument of a product of complex numbers, from one
    arctangent and the number of times that the product came across the real axis."""
    n, m = ring.dots.shape
    x, y, half_turns = np.ones(m), np.zeros(m), np.zeros(m)
    for i in range(n):
        for k in range(m):
            # By |e_i|^2 instead of |e_i| |e_{i+1}|: around the ring their product is the same.
            scale = 1 / ring.squares[i, k]
            cosine, sine = scale * ring.dots[i, k], scale * (2 * ring.areas[i, k])
            turned = x[k] * sine + y[k] * cosine
            x[k] = x[k] * cosine - y[k] * sine
            # One where the sign, also of a zero, changes.
            half_turns[k] += abs(math.copysign(0.5, turned) - math.copysign(0.5, y[k]))
            y[k] = turned
    for k in range(m):
        half_turns[k] = math.pi * half_turns[k] + (math.pi / 2 - math.atan(x[k] / y[k]))
    return half_turns


@compiled
def beta(ring):
    """Signed dihedral angle at e_i, between N_{i-1} and N_i, (n, m): convex positive.

    (e_{i-1} x e_i) x (e_i x e_{i+1}) is e_i times the determinant of the three.
    """
    n, m = ring.lengths.shape
    out = np.empty((n, m))
    for i in range(n):
        for k in range(m):
            before, facet = at(ring.facets, i - 1, k), at(ring.facets, i, k)
            determinant = dot(before, at(ring.e, (i + 1) % n, k))
            out[i, k] = angle(dot(before, facet), -ring.lengths[i, k] * determinant)
    return out


@compiled
def mixed_area(ring):
    """Mixed Voronoi cell of v (Meyer, Desbrun, Schroeder, Barr 2003, section 3.3), (m,)."""
    n, m = ring.areas.shape
    out = np.zeros(m)
    for i in range(n):
        j = (i + 1) % n
        for k in range(m):
            at_v = ring.dots[i, k]
            at_i, at_j = ring.squares[i, k] - at_v, ring.squares[j, k] - at_v
            if at_v >= 0 and at_i >= 0 and at_j >= 0:
                # |e_i|^2 cot(angle at v_{i+1}) + |e_{i+1}|^2 cot(angle at v_i), over 8.
                cotangents = ring.squares[i, k] * at_j + ring.squares[j, k] * at_i
                out[k] += cotangents / (16 * ring.areas[i, k])
            else:
                out[k] += ring.areas[i, k] / (2 if at_v < 0 else 4)
    return out


@compiled
def unit_normal(ring, kind):
    """N_v, (3, m) unit: mean of the facet normals (3.3), plain or by area, or the exact one.

    InputError for "exact" where the mesh has no normals.
    """
    n, m = ring.areas.shape
    if kind == "exact":
        if ring.exact_normals.shape[1] != m:
            raise InputError("normal='exact' needs a mesh with normals; this one has none")
        return ring.exact_normals
    N = np.zeros((3, m))
    by_area = kind == "area"
    for i in range(n):
        for k in range(m):
            weight = 1.0 if by_area else 1 / ring.areas[i, k]
            N[0, k], N[1, k], N[2, k] = add(at(N, k), weight, at(ring.facets, i, k))
    for k in range(m):
        N[0, k], N[1, k], N[2, k] = divide(at(N, k), norm(at(N, k)))
    return N


@compiled
def canonical(ring, N):
    """x, y, z of the canonical form, (3, n, m): the neighbours with v at the origin and -N_v
    along the z axis.

    The paper's form, turned over: z is the depth below the tangent plane, so that a surface
    which bends away from its normal has positive curvature. (x, y) is along T_i of (3.23), and
    not of length one.
    """
    _, n, m = ring.e.shape
    X, Y = _tangents(N)
    out = np.empty((3, n, m))
    for i in range(n):
        for k in range(m):
            e = at(ring.e, i, k)
            out[0, i, k] = dot(e, at(X, k))
            out[1, i, k] = dot(e, at(Y, k))
            out[2, i, k] = -dot(e, at(N, k))
    return out


@compiled
def kn(ring, N):
    """Normal curvature towards each v_i (3.16), (n, m); positive where the surface bends away
    from its normal."""
    n, m = ring.squares.shape
    out = np.empty((n, m))
    for i in range(n):
        for k in range(m):
            out[i, k] = -2 * dot(at(ring.e, i, k), at(N, k)) / ring.squares[i, k]
    return out


@compiled
def _tangents(N):
    """Two unit vectors (3, m) each that with N (3, m) make a right-handed frame.

    Duff et al. 2017, Building an orthonormal basis, revisited (JCGT 6, 1).
    """
    X, Y = np.empty_like(N), np.empty_like(N)
    for k in range(N.shape[1]):
        x, y, z = at(N, k)
        sign = math.copysign(1.0, z)
        a = -1 / (sign + z)
        b = x * y * a
        X[0, k], X[1, k], X[2, k] = 1 + sign * x * x * a, sign * b, -sign * x
        Y[0, k], Y[1, k], Y[2, k] = b, sign + y * y * a, -y
    return X, Y
