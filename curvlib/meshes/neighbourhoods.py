"""Who is around a vertex beyond its one-ring: adjacency, as compressed sparse rows."""

from collections import namedtuple

import numpy as np

from curvlib.kit.compiled import compiled

from .corners import by_bucket, table_of
from .walks import LAST, MANY, slot_of, walk, walk_by_table

# What the triangles around a vertex form.
BROKEN, CLOSED, OPEN = 0, 1, 2

Adjacency = namedtuple("Adjacency", "offsets neighbours stars widest")
Adjacency.__doc__ = """Neighbours of each vertex, as compressed sparse rows.

Attributes
----------
offsets : (V + 1,) int64
    Row v is neighbours[offsets[v] : offsets[v + 1]].
neighbours : (offsets[V],) int32
    Counter-clockwise seen from outside; of a half-disk from one end to the other; of a vertex
    whose triangles form neither, none.
stars : (V,) uint8
    CLOSED where the triangles form a disk, OPEN where a half-disk, else BROKEN.
widest : int
    The number of neighbours in the longest row.
"""


def adjacency(faces, total, threads: int = 1) -> Adjacency:
    """The Adjacency of `total` vertices, from faces (F, 3); 33 bytes a vertex of a closed mesh."""

    def rows(first, own, pairs, begin, valence, rings):
        lengths = np.zeros(len(valence), dtype=np.int64)
        stars = np.zeros(len(valence), dtype=np.uint8)
        row = np.empty(len(pairs) + len(valence), dtype=np.int32)
        table = table_of(int(np.diff(begin).max(initial=0)) + 1)
        return row[: _rows(pairs, begin, valence, table, lengths, stars, row)], lengths, stars

    # Without vertices there is no bucket.
    empty = np.empty(0, np.int32), np.empty(0, np.int64), np.empty(0, np.uint8)
    found = [empty, *by_bucket(faces, total, threads, rows)]
    neighbours, lengths, stars = map(np.concatenate, zip(*found))
    missing = total - len(lengths)  # of a mesh without faces
    lengths, stars = np.pad(lengths, (0, missing)), np.pad(stars, (0, missing))
    offsets = np.zeros(total + 1, dtype=np.int64)
    lengths.cumsum(out=offsets[1:])
    return Adjacency(offsets, neighbours, stars, int(lengths.max(initial=0)))


@compiled
def _rows(pairs, begin, valence, table, lengths, stars, rows):
    """Set the star of each vertex of a bucket, the length of its row and the row; the number of
    neighbours in all rows."""
    place = 0
    for v in range(len(stars)):
        first, n = begin[v], np.int64(begin[v + 1]) - begin[v]
        if valence[v] > 0:
            stars[v], lengths[v] = CLOSED, n
            for i in range(n):
                rows[place + i] = pairs[first + i] >> 32
        elif n > 0:
            own = _closed(pairs[first : first + n], table)
            if len(own) > 0 and (walk(own) if n + 1 < MANY else walk_by_table(own, table)):
                # Its first pair is no triangle: it leads from the last neighbour to the first.
                stars[v], lengths[v] = OPEN, n + 1
                for i in range(n + 1):
                    rows[place + i] = own[i] & LAST
        place += lengths[v]
    return place


@compiled
def _closed(pairs, table):
    """The pairs behind another one, from the last neighbour of a half-disk to its first; nothing
    where there is no such pair."""
    n = len(pairs)
    turned = np.empty(n, np.int64)
    for i in range(n):
        turned[i] = (pairs[i] & LAST) << 32 | pairs[i] >> 32
    first, last = _loose(turned, table), _loose(pairs, table)
    closed = np.empty(n + 1 if first >= 0 and last >= 0 else 0, np.int64)
    if len(closed) > 0:
        closed[0] = last << 32 | first
        for i in range(n):
            closed[i + 1] = pairs[i]
    return closed


@compiled
def _loose(pairs, table):
    """The one vertex at which a pair ends and none starts; -1 where there is not exactly one."""
    n, bits, loose = len(pairs), 1, -1
    while 1 << bits < 2 * n:
        bits += 1
    for slot in range(1 << bits):
        table[slot] = -1
    for i in range(n):
        table[slot_of(pairs[i] >> 32, pairs, table, bits)] = i
    for i in range(n):
        vertex = pairs[i] & LAST
        if table[slot_of(vertex, pairs, table, bits)] < 0:
            if loose >= 0:
                return -1
            loose = vertex
    return loose


def mean_edge(mesh) -> float:
    """Mean length of the edges at vertices whose triangles form a disk or half-disk, in the unit of
    the mesh."""
    offsets, neighbours, _, _ = mesh.find_adjacency()
    return _mean_edge(mesh.vertices, offsets, neighbours, mesh.unit) / mesh.unit


@compiled
def _mean_edge(vertices, offsets, neighbours, unit):
    total = 0.0
    for v in range(len(vertices)):
        for j in range(offsets[v], offsets[v + 1]):
            square = 0.0
            for c in range(3):
                difference = (vertices[neighbours[j], c] - vertices[v, c]) * unit
                square += difference * difference
            total += np.sqrt(square)
    return total / len(neighbours)
