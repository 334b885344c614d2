"""From faces to one-rings: their corners, sorted by vertex and walked around each.

A corner is a vertex of a face; the two that follow it there are the corner's pair, packed into
one integer as next * 2^32 + last. Corners are dealt out to buckets of consecutive vertices
first, so that sorting and walking stay in cache, however the faces come; parts of the faces,
and buckets, are independent of each other.
"""

import numpy as np

from curvlib.errors import InputError
from curvlib.kit.compiled import compiled
from curvlib.parallel import for_each

# 2^SHIFT vertices make a bucket, whose corners stay in cache: at most 16, since in their bucket
# vertices are counted in 16 bits.
SHIFT = 14
PART = 65536  # faces
LAST = (1 << 32) - 1
# From this valence on the corner that follows is looked up in a table, not among all.
MANY = 64


def one_rings(faces, total, threads: int = 1):
    """Closed one-rings of the vertices of faces (F, 3): list of (vertices (m,), neighbours (n, m)),
    int32, in batches of equal valence n.

    `total`: the number of vertices. InputError where a face refers to none of them.
    """
    parts = [slice(k, k + PART) for k in range(0, len(faces), PART)]
    counts = np.zeros((len(parts), (total >> SHIFT) + 1), dtype=np.intp)
    places = np.zeros(counts.size + 1, dtype=np.intp)
    owners = np.empty(3 * len(faces), dtype=np.uint16)
    pairs = np.empty(3 * len(faces), dtype=np.int64)
    vertices, neighbours = np.empty(total, dtype=np.int32), np.empty(len(pairs), dtype=np.int32)

    def count(part):
        # New memory is zeroed page by page when first written to: here by one thread each,
        # where corners are dealt out by all threads at a time.
        own = slice(3 * parts[part].start, 3 * parts[part].stop)
        owners[own][::2048], pairs[own][::512] = 0, 0
        # A mesh has looked at its faces when it was made; but the array may be shared.
        if not _count(faces[parts[part]], total, SHIFT, counts[part]):
            raise InputError("faces: changed since the mesh was made, to what is no vertex")

    def deal(part):
        _deal(faces[parts[part]], SHIFT, starts[part], owners, pairs)

    def walk(bucket):
        first, own = bucket << SHIFT, slice(*ends[bucket : bucket + 2])
        found = vertices[first : first + (1 << SHIFT)], neighbours[own]
        rings = _walk(owners[own], pairs[own], first, total, *found)
        return list(_batches(rings, *found))

    for_each(count, range(len(parts)), threads)
    # Bucket by bucket, and in each part by part: in the order of the faces.
    counts.T.cumsum(out=places[1:])
    starts = places[:-1].reshape(counts.shape[::-1]).T.copy()
    for_each(deal, range(len(parts)), threads)
    ends = places[:: len(parts)] if parts else []
    batches = for_each(walk, range(len(ends) - 1), threads)
    return [batch for found in batches for batch in found]


def _batches(rings, vertices, neighbours):
    """Yield the batches, whose numbers of rings by valence are known."""
    for n in np.flatnonzero(rings):
        m = rings[n]
        yield vertices[:m], neighbours[: n * m].reshape(n, m)
        vertices, neighbours = vertices[m:], neighbours[n * m :]


@compiled
def _count(faces, total, shift, counts):
    """Add to counts (buckets,) the corners of faces (F, 3) that lie in each bucket; whether all
    refer to one of a total of vertices."""
    for f in range(len(faces)):
        for c in range(3):
            if not 0 <= faces[f, c] < total:
                return False
            counts[faces[f, c] >> shift] += 1
    return True


@compiled
def _deal(faces, shift, places, owners, pairs):
    """Write the corners' vertices, counted in their bucket, and pairs, (corners,) each, from
    places (buckets,) on, which move along."""
    for f in range(len(faces)):
        for c in range(3):
            v = faces[f, c]
            place = places[v >> shift]
            places[v >> shift] = place + 1
            owners[place] = v - (v >> shift << shift)
            pairs[place] = faces[f, (c + 1) % 3] << 32 | faces[f, (c + 2) % 3]


@compiled
def _walk(owners, pairs, first, total, order, neighbours):
    """One-rings of the vertices from `first` on, whose corners these are.

    Returns how many closed ones there are by valence. Sets `order` (vertices,) to their vertices
    by rising valence, and `neighbours` (corners,) to their neighbours, of each valence n an
    (n, m), one after the other; what is left over stays as it is. `total`: of vertices in the
    mesh.
    """
    vertices = len(order)
    begin, pairs = _by_vertex(owners, pairs, vertices)
    valence, table = np.zeros(vertices, np.uint32), np.zeros(0, np.int32)
    for v in range(vertices):
        own = pairs[begin[v] : begin[v + 1]]
        if len(own) >= MANY and len(table) == 0:
            table = np.full(total, -1, np.int32)
        if len(own) >= 3 and (_sort(own) if len(own) < MANY else _sort_by_table(own, table)):
            valence[v] = len(own)

    largest = 0
    for n in valence:
        largest = max(largest, n)
    rings = np.zeros(largest + 1, np.int64)
    for n in valence:
        rings[n] += 1
    rings[0] = 0
    # Of each valence: where its vertices and its neighbours begin, and how many are written.
    at, neighbours_at, written = np.zeros((3, largest + 2), np.int64)
    for n in range(largest + 1):
        at[n + 1] = at[n] + rings[n]
        neighbours_at[n + 1] = neighbours_at[n] + n * rings[n]
    for v in range(vertices):
        n = valence[v]
        if n > 0:
            k = written[n]
            written[n] = k + 1
            order[at[n] + k] = first + v
            for i in range(n):
                neighbours[neighbours_at[n] + i * rings[n] + k] = pairs[begin[v] + i] >> 32
    return rings


@compiled
def _by_vertex(owners, pairs, vertices):
    """Where the pairs of each vertex begin, (vertices + 1,), and the pairs in that order."""
    begin = np.zeros(vertices + 1, np.uint32)
    for owner in owners:
        begin[owner + np.uint32(1)] += np.uint32(1)
    for v in range(vertices):
        begin[v + 1] += begin[v]
    place, ordered = begin.copy(), np.empty_like(pairs)
    for row in range(len(owners)):
        ordered[place[owners[row]]] = pairs[row]
        place[owners[row]] += np.uint32(1)
    return begin, ordered


@compiled
def _sort(pairs):
    """Bring the pairs of a vertex in the order of a walk; whether it came by all and back."""
    n, start = len(pairs), pairs[0] >> 32
    for i in range(1, n):
        vertex = pairs[i - 1] & LAST
        found = _find(vertex, pairs, i)
        if vertex == start or found == n or _find(vertex, pairs, found + 1) < n:
            return False
        pairs[i], pairs[found] = pairs[found], pairs[i]
    return pairs[n - 1] & LAST == start


@compiled
def _find(vertex, pairs, place):
    """The first place from this one on of a pair that starts with a vertex, or else the end."""
    while place < len(pairs) and pairs[place] >> 32 != vertex:
        place += 1
    return place


@compiled
def _sort_by_table(pairs, table):
    """As `_sort`, by a table of -1 for each vertex, in which each neighbour has its pair."""
    walked = np.empty_like(pairs)
    for i in range(len(pairs)):
        table[pairs[i] >> 32] = i
    i = steps = 0
    while steps < len(pairs) and i >= 0 and (i > 0 or steps == 0):
        walked[steps] = pairs[i]
        i = table[pairs[i] & LAST]
        steps += 1
    for pair in pairs:
        table[pair >> 32] = -1
    closed = steps == len(pairs) and i == 0
    if closed:
        pairs[:] = walked
    return closed
