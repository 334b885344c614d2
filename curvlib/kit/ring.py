"""One-rings of vertices and their quantities, in the letters of the 2003 paper.

A Ring is a batch of m one-rings of equal valence n. Arrays are component first, (3, n, m), and
the inner loop runs over the m rings, contiguous in memory, which the compiler vectorises.
The ring of v is v_0 ... v_{n-1}, counter-clockwise seen from the side the normal points to;
indices are taken mod n. Angles are in radians, lengths in the unit of the mesh (see `batch.unit`).
Functions take a Ring, or an array `x` (n, m) of a value per edge or triangle, and never write to
it. Each returns NaN for a ring with a degenerate triangle.
"""

import math
from collections import namedtuple

import numpy as np

from .compiled import compiled
from .vectors import at, cross, dot

# A triangle lower than this fraction of its sides is degenerate: its normal has at most four
# correct digits in float64.
FLAT = 1e-12
# So is one lower than this fraction of |v|, 16 rounding errors of a coordinate: rounding changes
# its height by a tenth. A triangle with an edge as short is as low.
ROUNDING = 2.0**-49
# A fold within this angle of pi, in radians, is a sheet without thickness: rounding decides which
# side is the outer one, for edges down to 1e-6 of the largest coordinate.
SHEET = 1e-9

Ring = namedtuple("Ring", "e exact_normals squares lengths facets areas dots")
Ring.__doc__ = """m one-rings of valence n.

A ring with a degenerate triangle is NaN in every field but `exact_normals`, and so is each value
made of it. Degenerate is a triangle of which rounding decides the shape: twice its area is at
most s sqrt((FLAT s)^2 + (ROUNDING |v|)^2), s^2 being the sum of its squared sides.

Attributes
----------
e : (3, n, m)
    Edge vectors e_i = v_i - v.
exact_normals : (3, m)
    Unit normals of the surface; (3, 0) where the mesh has none.
squares : (n, m)
    |e_i|^2.
lengths : (n, m)
    |e_i|.
facets : (3, n, m)
    e_i x e_{i+1}, along the normal of T_i = (v_i, v, v_{i+1}) and as long as twice its area.
areas : (n, m)
    The area of T_i (3.1).
dots : (n, m)
    e_i . e_{i+1}.
"""


def one_ring(e, exact_normals):
    """The Ring of edge vectors.

    Parameters
    ----------
    e : (3, n, m)
        Edge vectors, counter-clockwise; copied.
    exact_normals : (3, m) or (3, 0)
        Unit normals of the surface, where they are known.

    Returns
    -------
    Ring
    """
    e = np.array(e, dtype=float, order="C")
    return defined(*owning_ring(e, exact_normals, np.zeros(e.shape[2])))


@compiled
def owning_ring(e, exact_normals, floors):
    """The Ring of `one_ring(e, exact_normals)` without a copy of `e`, and the number of degenerate
    triangles, for `defined`. `floors` (m,): (ROUNDING |v|)^2, the square of the height up to which
    rounding decides the shape of a triangle."""
    _, n, m = e.shape
    squares, lengths, areas = np.empty((n, m)), np.empty((n, m)), np.empty((n, m))
    dots, facets = np.empty((n, m)), np.empty((3, n, m))
    degenerate = 0
    for i in range(n):
        j = (i + 1) % n
        for k in range(m):
            a, b = at(e, i, k), at(e, j, k)
            c = cross(a, b)
            facets[0, i, k], facets[1, i, k], facets[2, i, k] = c
            aa, ab, cc = dot(a, a), dot(a, b), dot(c, c)
            squares[i, k], lengths[i, k], dots[i, k] = aa, np.sqrt(aa), ab
            sides = 2 * (aa + dot(b, b) - ab)
            proper = cc > sides * (FLAT**2 * sides + floors[k])
            areas[i, k] = np.sqrt(cc) / 2 if proper else np.nan
            degenerate += 0 if proper else 1
    return Ring(e, exact_normals, squares, lengths, facets, areas, dots), degenerate


def defined(ring, degenerate):
    """The Ring, written to: rings with one of the `degenerate` triangles are NaN."""
    if degenerate:
        some = ~np.isfinite(ring.areas.sum(0))
        for field in ring:
            if field is not ring.exact_normals:
                field[..., some] = np.nan
    return ring


@compiled
def zeros(m):
    """(m,) zeros. np.zeros calls another four functions, compiled in 0.1 s."""
    out = np.empty(m)
    for k in range(m):
        out[k] = 0.0
    return out


@compiled
def total(x):
    """Sum over the ring, (m,), of (n, m)."""
    n, m = x.shape
    out = zeros(m)
    for i in range(n):
        for k in range(m):
            out[k] += x[i, k]
    return out


@compiled
def weighted_total(weights, x):
    """Sum over the ring, (m,), of weights (n, m) times x (n, m)."""
    n, m = x.shape
    out = zeros(m)
    for i in range(n):
        for k in range(m):
            out[k] += weights[i, k] * x[i, k]
    return out


@compiled
def with_preceding(x):
    """x_{i-1} + x_i, (n, m): for values of triangles, the sum over the two that share e_i."""
    n, m = x.shape
    out = np.empty((n, m))
    for i in range(n):
        for k in range(m):
            out[i, k] = x[i - 1, k] + x[i, k]
    return out


@compiled
def following(x):
    """x_{i+1} at i, (n, m)."""
    n, m = x.shape
    out = np.empty((n, m))
    for i in range(n):
        for k in range(m):
            out[i, k] = x[(i + 1) % n, k]
    return out


@compiled
def alpha(ring):
    """alpha_i = angle(v_i, v, v_{i+1}), (n, m), in [0, pi]."""
    areas, dots = ring.areas, ring.dots
    n, m = areas.shape
    out = np.empty((n, m))
    for i in range(n):
        for k in range(m):
            # arctan2(2 area, dot) by one arctangent: the area is not negative.
            out[i, k] = math.pi / 2 - math.atan(dots[i, k] / (2 * areas[i, k]))
    return out


@compiled
def total_angle(ring):
    """Sum of all alpha_i, (m,), in radians.

    It is the argument of the product of the e_i . e_{i+1} + 1j |e_i x e_{i+1}|, from one
    arctangent and the number of times that the product crosses the real axis.
    """
    squares, dots, areas = ring.squares, ring.dots, ring.areas
    n, m = dots.shape
    x, y, half_turns = np.empty(m), zeros(m), zeros(m)
    for k in range(m):
        x[k] = 1.0
    for i in range(n):
        for k in range(m):
            # Scaled by |e_i|^2 instead of |e_i| |e_{i+1}|, whose product around the ring is equal.
            scale = 1 / squares[i, k]
            cosine, sine = scale * dots[i, k], scale * (2 * areas[i, k])
            turned = x[k] * sine + y[k] * cosine
            x[k] = x[k] * cosine - y[k] * sine
            # Add 1 where the sign, that of a zero included, changes.
            half_turns[k] += abs(math.copysign(0.5, turned) - math.copysign(0.5, y[k]))
            y[k] = turned
    for k in range(m):
        half_turns[k] = math.pi * half_turns[k] + (math.pi / 2 - math.atan(x[k] / y[k]))
    return half_turns


@compiled
def beta(ring):
    """Signed dihedral angle at e_i, between N_{i-1} and N_i, (n, m), in (-pi, pi), convex positive.

    NaN within SHEET of +-pi: a sheet without thickness has no outer side.
    """
    e, lengths, facets = ring.e, ring.lengths, ring.facets
    n, m = lengths.shape
    tangent, turn, out = np.empty(m), np.empty(m), np.empty((n, m))
    for i in range(n):
        for k in range(m):
            before, facet = at(facets, i - 1, k), at(facets, i, k)
            # The triple product of three edges is the same sine, but cancels between slivers.
            sine = -dot(at(e, i, k), cross(before, facet))
            cosine = lengths[i, k] * dot(before, facet)
            tangent[k] = sine / cosine
            turn[k] = math.copysign(math.pi, sine) if cosine < 0 else 0.0
        # Arctangents in a loop of their own leave the first one vectorised.
        for k in range(m):
            angle = math.atan(tangent[k]) + turn[k]
            out[i, k] = angle if abs(angle) < math.pi - SHEET else np.nan
    return out


@compiled
def mixed_area(ring):
    """Area of the mixed Voronoi cell of v, (m,).

    Source: Meyer, Desbrun, Schroeder, Barr (2003), section 3.3.
    """
    squares, dots, areas = ring.squares, ring.dots, ring.areas
    n, m = areas.shape
    out = zeros(m)
    for i in range(n):
        j = (i + 1) % n
        for k in range(m):
            at_v = dots[i, k]
            at_i, at_j = squares[i, k] - at_v, squares[j, k] - at_v
            if at_v >= 0 and at_i >= 0 and at_j >= 0:
                # |e_i|^2 cot(angle at v_{i+1}) + |e_{i+1}|^2 cot(angle at v_i), over 8.
                cotangents = squares[i, k] * at_j + squares[j, k] * at_i
                out[k] += cotangents / (16 * areas[i, k])
            else:
                out[k] += areas[i, k] / (2 if at_v < 0 else 4)
    return out
