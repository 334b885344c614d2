"""Edges between two smooth pieces of surface: polynomials fitted on either side of an edge, against
one over both."""

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.vectors import add, cross, divide, dot, norm, times

# Vertices within RINGS of an edge, at most MOST; a fit leaves at least SPARE of them.
RINGS, MOST, SPARE = 2, 128, 3
# Degrees of the polynomials of one side and of both; the coefficients of the latter.
SIDE, BOTH, TERMS = 2, 3, 10
# The part of the edge's turn at which the sides have to meet, and the least turn, in radians.
MEET, TURN = 0.5, 0.05
# A vertex within this part of the edge's length of it is on both sides.
BESIDE = 0.05
# The square of rounding errors of coordinates over the distance of vertices.
ROUNDING = 1e-14
# A part of a monomial, squared, that is dependent on the ones before; a leverage of one.
DEPENDENT, FREE = 1e-8, 1e-6


@compiled
def scores(mesh, edges, turns, least, memory, found):
    """Set found (m,) to how much better two polynomials fit than one, for edges (m, 4) that turn by
    turns (m,); 0 where the sides meet at less than half of that angle, or too few vertices
    determine them.

    `mesh`: vertices, offsets and neighbours of an Adjacency, the largest turn (V,) at each vertex;
    `least`: the error that is expected of any vertex, in their unit; `memory`: two (V,) int32, the
    first zeros.

    Notes
    -----
    Polynomials of degree 2 are fitted to the heights of the vertices within two rings of the edge
    on either side, of degree 3 to those on both. The score is the residual variance of the latter
    over the mean square error at vertices that are left out of a fit of one side. On a smooth
    surface it is about 1 or below at any resolution, since one degree more over both sides is worth
    more than half the width; below 4 under white noise, which both fit alike.

    A side is what is connected with its triangle, but not over vertices with an edge that turns
    half as much; where this leaves too little, what lies on one side of the plane along the edge
    and the normal.
    """
    vertices, offsets, neighbours, _ = mesh
    near, points, sides = np.empty(MOST, np.int32), np.empty((3, MOST)), np.empty(MOST, np.uint8)
    own = points, sides, np.empty((3, MOST)), np.empty((TERMS, MOST + 2))
    for k in range(len(edges)):
        v, w, x, y = edges[k]
        left, right, along = normals_beside(vertices, v, w, x, y)
        found[k] = 0.0
        if not (abs(turns[k]) > TURN and dot(left, left) > 0 and dot(right, right) > 0):
            continue
        count = _near(offsets, neighbours, v, w, memory, k + 1, near)
        if count > MOST:
            continue
        size = _gather(vertices, v, w, near, count, points)
        limit, square = MEET * abs(turns[k]), (least / size) ** 2 + ROUNDING
        _connected(mesh, (v, w, x, y), limit, near, count, memory, k + 1, sides)
        found[k] = _score(own, count, left, right, along, turns[k], square)
        if found[k] == 0:
            _divided(points, count, left, right, along, norm(along) / size, sides)
            found[k] = _score(own, count, left, right, along, turns[k], square)


@compiled
def _score(own, count, left, right, along, turn, square):
    left_error, m, p = _fit(own, count, left, along, SIDE, 1)
    right_error, n, q = _fit(own, count, right, along, SIDE, 2)
    if min(m, n) > 0 and turn_about(q, p, along) * np.sign(turn) > MEET * abs(turn):
        error, spare, _ = _fit(own, count, add(p, 1.0, q), along, BOTH, 3)
        if spare > 0:
            apart = (left_error + right_error) / (m + n)
            return error / spare / (apart + square)
    return 0.0


@compiled
def normals_beside(vertices, v, w, x, y):
    """Unit normals of the triangles (v, w, x) and (v, y, w), zero of one without area; w - v."""
    along = _step(vertices, v, w)
    left = cross(along, _step(vertices, v, x))
    right = cross(_step(vertices, v, y), along)
    a, b = norm(left), norm(right)
    return times(left, 1 / a if a > 0 else 0.0), times(right, 1 / b if b > 0 else 0.0), along


@compiled
def _step(vertices, a, b):
    return (
        vertices[b, 0] - vertices[a, 0],
        vertices[b, 1] - vertices[a, 1],
        vertices[b, 2] - vertices[a, 2],
    )


@compiled
def turn_about(right, left, along):
    """From one unit normal to the other about an edge, in radians."""
    return np.arctan2(dot(cross(right, left), along) / norm(along), dot(right, left))


@compiled
def _near(offsets, neighbours, v, w, memory, stamp, near):
    """The vertices within RINGS of an edge, and how many; more than MOST if they are too many. Sets
    the places of them."""
    stamps, places = memory
    near[0], near[1], places[v], places[w] = v, w, 0, 1
    stamps[v] = stamps[w] = stamp
    start, count = 0, 2
    for _ in range(RINGS):
        end = count
        for i in range(start, end):
            for j in range(offsets[near[i]], offsets[near[i] + 1]):
                other = neighbours[j]
                if stamps[other] != stamp:
                    if count == MOST:
                        return MOST + 1
                    stamps[other], places[other] = stamp, count
                    near[count] = other
                    count += 1
        start = end
    return count


@compiled
def _connected(mesh, edge, limit, near, count, memory, stamp, sides):
    """Set sides (count,) to 1 left, 2 right of the edge, 3 on both, by what is connected over
    vertices at which no edge turns by more than the limit."""
    _, offsets, neighbours, sharpest = mesh
    v, w, x, y = edge
    stamps, places = memory
    for i in range(count):
        sides[i] = 0
    for side, start in ((1, x), (2, y)):
        sides[places[v]] |= side
        sides[places[w]] |= side
        sides[places[start]] |= side
        for _ in range(RINGS):
            # In the order of rings; what a ring reaches is passed on in the next round.
            for i in range(count):
                u = near[i]
                if not sides[i] & side or sharpest[u] > limit:
                    continue
                for j in range(offsets[u], offsets[u + 1]):
                    if stamps[neighbours[j]] == stamp:
                        sides[places[neighbours[j]]] |= side


@compiled
def _divided(points, count, left, right, along, length, sides):
    """Set sides (count,) to 1 left, 2 right of the edge, 3 on it."""
    across = cross(add(left, 1.0, right), along)
    across = divide(across, norm(across))
    for i in range(count):
        distance = dot((points[0, i], points[1, i], points[2, i]), across)
        sides[i] = 3 if abs(distance) < BESIDE * length else 1 if distance > 0 else 2


@compiled
def _gather(vertices, v, w, near, count, points):
    """Set points (3, count) relative to the middle of the edge, their root mean square distance
    being 1; returns that."""
    square = 0.0
    for i in range(count):
        for c in range(3):
            points[c, i] = vertices[near[i], c] - (vertices[v, c] + vertices[w, c]) / 2
            square += points[c, i] * points[c, i]
    size = np.sqrt(square / count)
    for i in range(count):
        for c in range(3):
            points[c, i] /= size
    return size


@compiled
def _fit(own, count, up, along, degree, side):
    """Of the polynomial over both sides, 3, the sum of squared residuals and how many are spare;
    over the left, 1, or the right, 2, the sum of squared errors at points that are left out and how
    many points; 0 where there are too few. Then its unit normal at the middle of the edge."""
    points, sides, local, basis = own
    N = divide(up, norm(up))
    X = add(along, -dot(along, N), N)
    X = divide(X, norm(X))
    Y, n = cross(N, X), 0
    for i in range(count):
        if sides[i] & side:
            p = points[0, i], points[1, i], points[2, i]
            local[0, n], local[1, n], local[2, n] = dot(p, X), dot(p, Y), dot(p, N)
            n += 1
    m = _orthonormalise(local, n, degree, basis)
    if n - m < SPARE:
        return 0.0, 0, N
    z, x, y = local[2], 0.0, 0.0
    for c in range(m):
        product = _product(basis[c], z, n)
        x, y = x + product * basis[c, n], y + product * basis[c, n + 1]
        for i in range(n):
            z[i] -= product * basis[c, i]
    total, number = 0.0, 0
    for i in range(n):
        rest = 1.0
        for c in range(m if side < 3 else 0):
            rest -= basis[c, i] * basis[c, i]
        # A point that alone determines a coefficient has no error.
        if rest > FREE:
            total += (z[i] / rest) ** 2
            number += 1
    r = np.sqrt(1 + x * x + y * y)
    normal = divide(add(add(N, -x, X), -y, Y), r)
    return total, number if side < 3 else n - m, normal


@compiled
def _orthonormalise(local, n, degree, basis):
    """Monomials at n points, orthonormal, as rows of the basis, and how many are independent; in
    columns n and n + 1 their derivatives at the origin to x and to y."""
    m = 0
    for total in range(degree + 1):
        for j in range(total + 1):
            row = basis[m]
            for i in range(n):
                row[i] = local[0, i] ** (total - j) * local[1, i] ** j
            row[n] = 1.0 if total == 1 and j == 0 else 0.0
            row[n + 1] = 1.0 if total == 1 and j == 1 else 0.0
            square = _product(row, row, n)
            for _ in range(2):  # twice is enough
                for c in range(m):
                    product = _product(basis[c], row, n)
                    for i in range(n + 2):
                        row[i] -= product * basis[c, i]
            rest = _product(row, row, n)
            if rest > DEPENDENT * square:
                for i in range(n + 2):
                    row[i] /= np.sqrt(rest)
                m += 1
    return m


@compiled
def _product(a, b, n):
    total = 0.0
    for i in range(n):
        total += a[i] * b[i]
    return total
