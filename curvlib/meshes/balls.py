"""The triangles of a mesh within some length of a vertex, connected to it within that."""

import numpy as np

from curvlib.kit.compiled import kernel
from curvlib.kit.vectors import add, dot

from .neighbourhoods import BROKEN, CLOSED
from .walks import LAST

NOT_YET = -2  # instead of the triangle behind an edge


@kernel
def triangles_within(adjacency, vertices, v, radius, memory):
    """Find the triangles that are connected to a vertex through edges that meet the open ball.

    Parameters
    ----------
    adjacency : tuple
        `offsets`, `neighbours` and `stars` of an Adjacency.
    vertices : (V, 3)
    v : int
        The vertex.
    radius : float
        Of the ball about v; infinite for the triangles at v alone.
    memory : tuple
        `marks` (V,) int64 and `places` (offsets[V],) int64, zeros, or of searches from other
        vertices; `found` int32, `corners` and `beyond` int32, of lengths n, 6 n and 6 n.

    Returns
    -------
    count, number : int
        Of vertices other than v, which are in `found`; of triangles, whose corners are in
        `corners`, three a triangle, 0 standing for v and i + 1 for found[i], and the triangles
        behind their edges in `beyond`. -1 where the memory does not suffice.
    """
    offsets, neighbours, stars = adjacency
    marks, places, found, corners, beyond = memory
    mark, count, number, most = np.int64(v + 1) << 32, 0, 0, len(corners) // 3
    first, last = offsets[v], offsets[v + 1]
    marks[v] = mark
    open_ = stars[v] != CLOSED
    if last - first > min(most, len(found)):
        return -1, -1
    for j in range(first, last):
        found[count] = neighbours[j]
        count += 1
        marks[neighbours[j]] = mark | count
    for j in range(first, last - open_):
        b, c = neighbours[j], neighbours[j + 1 if j + 1 < last else first]
        places[_place(adjacency, v, b, c)] = mark | number
        _put(corners, beyond, number, 0, marks[b] & LAST, marks[c] & LAST)
        number += 1
    t = 0
    while t < number:
        for k in range(3):
            here = 3 * t + k
            if beyond[here] != NOT_YET:
                continue
            beyond[here] = -1
            i, j = corners[here], corners[3 * t + (k + 1) % 3]
            if not _meets(vertices, v, found, i, j, radius):
                continue
            b, c = _vertex(v, found, i), _vertex(v, found, j)
            d = _apex(adjacency, c, b)
            if d < 0:
                continue
            place = _place(adjacency, c, b, d)
            if places[place] >> 32 << 32 != mark:
                if number == most or count == len(found):
                    return -1, -1
                if marks[d] >> 32 << 32 != mark:
                    found[count] = d
                    count += 1
                    marks[d] = mark | count
                places[place] = mark | number
                _put(corners, beyond, number, j, i, marks[d] & LAST)
                number += 1
            other = places[place] & LAST
            beyond[here] = other
            for edge in range(3 * other, 3 * other + 3):
                if corners[edge] == j:
                    beyond[edge] = t
        t += 1
    return count, number


@kernel
def _put(corners, beyond, t, i, j, k):
    corners[3 * t], corners[3 * t + 1], corners[3 * t + 2] = i, j, k
    beyond[3 * t], beyond[3 * t + 1], beyond[3 * t + 2] = NOT_YET, NOT_YET, NOT_YET


@kernel
def _vertex(v, found, i):
    return np.int64(v) if i == 0 else np.int64(found[i - 1])


@kernel
def _meets(vertices, v, found, i, j, radius):
    """Whether the edge between two corners meets the open ball; of the infinite one those at v."""
    if radius == np.inf or i == 0 or j == 0:
        return i == 0 or j == 0
    p = _scaled(vertices, v, _vertex(v, found, i), radius)
    d = add(_scaled(vertices, v, _vertex(v, found, j), radius), -1.0, p)
    square = dot(d, d)
    t = min(max(-dot(p, d) / square, 0.0), 1.0) if square > 0 else 0.0
    nearest = add(p, t, d)
    return dot(nearest, nearest) < 1


@kernel
def _scaled(vertices, v, u, radius):
    """The vector from v to u, in units of the radius: its square is finite in any unit."""
    return (
        (vertices[u, 0] - vertices[v, 0]) / radius,
        (vertices[u, 1] - vertices[v, 1]) / radius,
        (vertices[u, 2] - vertices[v, 2]) / radius,
    )


@kernel
def _apex(adjacency, b, c):
    """The third corner of the triangle with the edge from b to c; -1 where there is none, or where
    it is not known since neither b nor c has a disk or half-disk."""
    offsets, neighbours, stars = adjacency
    # The shorter row is searched: the time is proportional to the valence.
    if _before(adjacency, b, c):
        # In the row of b, the third corner follows c.
        first, last = offsets[b], offsets[b + 1]
        j = _index(neighbours, first, last, c) + 1
        if j == last and stars[b] == CLOSED:
            j = first
        return np.int64(neighbours[j]) if j < last else -1
    if stars[c] != BROKEN:
        # In the row of c, the third corner precedes b.
        first, last = offsets[c], offsets[c + 1]
        j = _index(neighbours, first, last, b) - 1
        if j < first and stars[c] == CLOSED:
            j = last - 1
        return np.int64(neighbours[j]) if j >= first else -1
    return -1


@kernel
def _before(adjacency, b, c):
    """Whether b has a row, and c none or a longer one, or one as long and a larger index."""
    offsets, _, stars = adjacency
    if stars[b] == BROKEN or stars[c] == BROKEN:
        return stars[b] != BROKEN
    p, q = offsets[b + 1] - offsets[b], offsets[c + 1] - offsets[c]
    return p < q or (p == q and b < c)


@kernel
def _place(adjacency, a, b, c):
    """A number of the triangle a, b, c of its own: the place of an edge of it in `neighbours`, in
    the shortest row of a corner."""
    offsets, neighbours, _ = adjacency
    if _before(adjacency, a, b) and _before(adjacency, a, c):
        return _index(neighbours, offsets[a], offsets[a + 1], b)
    if _before(adjacency, b, c) and not _before(adjacency, a, b):
        return _index(neighbours, offsets[b], offsets[b + 1], c)
    return _index(neighbours, offsets[c], offsets[c + 1], a)


@kernel
def _index(neighbours, first, last, u):
    """The place of u in a row; `last` where it is not there."""
    for j in range(first, last):
        if neighbours[j] == u:
            return j
    return last
