"""From faces to one-rings: sort corners by vertex, then walk around each vertex.

A corner is a vertex of a face; the two vertices that follow it in the face are its pair, packed
into one integer as next * 2^32 + last. A radix pass scatters the corners to buckets of consecutive
vertices, so that sorting and walking stay in cache for any order of faces. Parts of the faces are
independent of each other, and so are buckets.

A face that names a vertex twice has no area and no corners.
"""

import numpy as np

from curvlib.errors import InputError
from curvlib.kit.compiled import compiled
from curvlib.parallel import for_each

# 2^SHIFT vertices make a bucket, whose corners stay in cache. SHIFT is at most 16: places in a
# bucket are uint16.
SHIFT = 14
PART = 65536  # faces
LAST = (1 << 32) - 1
# From this valence on the walk finds the next pair by a hash table instead of a linear search.
MANY = 64


def one_rings(faces, total, threads: int = 1):
    """Closed one-rings of the vertices of faces (F, 3): list of (vertices (m,), neighbours (n, m)),
    int32, in batches of equal valence n.

    `total`: the number of vertices; Mesh checks that int32 counts them and the corners. Raises
    InputError if a face refers to no vertex.
    """
    # Read only as the faces of a Mesh: one array type, compiled once.
    faces = faces.view()
    faces.flags.writeable = False
    parts = [slice(k, k + PART) for k in range(0, len(faces), PART)]
    counts = np.zeros((len(parts), (total >> SHIFT) + 1), dtype=np.intp)
    places = np.zeros(counts.size + 1, dtype=np.intp)
    owners = np.empty(3 * len(faces), dtype=np.uint16)
    pairs = np.empty(3 * len(faces), dtype=np.int64)
    neighbours = np.empty(len(pairs), dtype=np.int32)

    def count(part):
        # First touch: each thread faults in its own pages before all threads scatter into them.
        own = slice(3 * parts[part].start, 3 * parts[part].stop)
        owners[own][::2048], pairs[own][::512] = 0, 0
        # Mesh has checked its faces; without a copy the caller may have written to them since.
        if not _count(faces[parts[part]], total, SHIFT, counts[part]):
            raise InputError("faces: changed since the mesh was made, to what is no vertex")

    def deal(part):
        _deal(faces[parts[part]], SHIFT, starts[part], owners, pairs)

    def walk(bucket):
        first, own = bucket << SHIFT, slice(*ends[bucket : bucket + 2])
        begin = np.zeros(min(1 << SHIFT, total - first) + 1, dtype=np.uint32)
        ordered = np.empty_like(pairs[own])
        _by_vertex(owners[own], pairs[own], begin, begin[:-1].copy(), ordered)
        valence = np.diff(begin)
        rings = np.zeros(int(valence.max(initial=0)) + 1, dtype=np.intp)
        _close(ordered, begin, _table(valence), valence, rings)
        return list(_batches(ordered, begin, valence, rings, first, neighbours[own]))

    for_each(count, range(len(parts)), threads)
    # Ordered by bucket, then by part, so that the corners of a vertex keep the order of the faces.
    counts.T.cumsum(out=places[1:])
    starts = places[:-1].reshape(counts.shape[::-1]).T.copy()
    for_each(deal, range(len(parts)), threads)
    ends = places[:: len(parts)] if parts else []
    batches = for_each(walk, range(len(ends) - 1), threads)
    return [batch for found in batches for batch in found]


def _table(valence):
    """Memory for `_walk_by_table` at the largest valence n: fewer than 4 n slots, and n pairs."""
    largest = int(valence.max(initial=0))
    return np.empty(5 * largest if largest >= MANY else 0, dtype=np.int64)


def _batches(pairs, begin, valence, rings, first, neighbours):
    """Yield the batches of a bucket, whose neighbours are written to `neighbours` (corners,).

    `rings`: how many there are of each valence.
    """
    slots = np.arange(len(rings)) * rings
    ends, vertices = rings.cumsum(), np.empty(rings.sum(), dtype=np.int32)
    at, slot = ends - rings, slots.cumsum() - slots
    _scatter(pairs, begin, valence, first, rings, at, slot, vertices, neighbours)
    for n in np.flatnonzero(rings):
        m = rings[n]
        yield vertices[:m], neighbours[: n * m].reshape(n, m)
        vertices, neighbours = vertices[m:], neighbours[n * m :]


@compiled
def _covers(a, b, c):
    """Whether a face names three vertices."""
    return a != b and b != c and c != a


@compiled
def _count(faces, total, shift, counts):
    """Add the corners of faces (F, 3) per bucket to counts (buckets,); False if an index is
    not in 0 ... total - 1."""
    most = np.uint64(total)
    for f in range(len(faces)):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        # Unsigned, a negative index is a large one.
        if np.uint64(a) >= most or np.uint64(b) >= most or np.uint64(c) >= most:
            return False
        if _covers(a, b, c):
            counts[a >> shift] += 1
            counts[b >> shift] += 1
            counts[c >> shift] += 1
    return True


@compiled
def _deal(faces, shift, places, owners, pairs):
    """Scatter vertices, relative to their bucket, and pairs of the corners, (corners,) each, from
    places (buckets,) on, which advance."""
    for f in range(len(faces)):
        if _covers(faces[f, 0], faces[f, 1], faces[f, 2]):
            for c in range(3):
                v = faces[f, c]
                place = places[v >> shift]
                places[v >> shift] = place + 1
                owners[place] = v - (v >> shift << shift)
                pairs[place] = faces[f, (c + 1) % 3] << 32 | faces[f, (c + 2) % 3]


@compiled
def _by_vertex(owners, pairs, begin, place, ordered):
    """Counting sort of the pairs by vertex: sets `ordered`, and `begin` (vertices + 1,) to the
    first pair of each vertex there. `place` (vertices,) is overwritten."""
    for row in range(len(owners)):
        begin[owners[row] + np.uint32(1)] += 1
    for v in range(len(place)):
        place[v] = begin[v]
        begin[v + 1] += begin[v]
    for row in range(len(owners)):
        v = owners[row]
        ordered[place[v]] = pairs[row]
        place[v] += 1


@compiled
def _close(pairs, begin, table, valence, rings):
    """Order the pairs of each vertex as a walk around it and count it in rings[its valence]; set
    the valence to zero where they do not close to one ring."""
    for v in range(len(valence)):
        own = pairs[begin[v] : begin[v + 1]]
        if len(own) >= 3 and (_walk(own) if len(own) < MANY else _walk_by_table(own, table)):
            rings[len(own)] += 1
        else:
            valence[v] = 0


@compiled
def _walk(pairs):
    """Order the pairs of a vertex as a walk; whether that visits all and closes."""
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
    """The first place, from `place` on, of a pair that starts with `vertex`, else len(pairs)."""
    while place < len(pairs) and pairs[place] >> 32 != vertex:
        place += 1
    return place


@compiled
def _walk_by_table(pairs, table):
    """As `_walk`, in O(n). The table maps a vertex to its pair, by open addressing; behind it the
    walk is collected, since the table refers to places in `pairs`."""
    n, bits = len(pairs), 1
    while 1 << bits < 2 * n:
        bits += 1
    walked = 1 << bits
    for slot in range(walked):
        table[slot] = -1
    for i in range(n):
        slot = _slot(pairs[i] >> 32, pairs, table, bits)
        if table[slot] >= 0:
            return False
        table[slot] = i
    i = 0
    for step in range(n):
        table[walked + step] = pairs[i]
        i = table[_slot(pairs[i] & LAST, pairs, table, bits)]
        if i < 0 or (i == 0) != (step == n - 1):
            return False
    for step in range(n):
        pairs[step] = table[walked + step]
    return True


@compiled
def _slot(vertex, pairs, table, bits):
    """The slot of a vertex in a table of 2^bits, or the empty slot for it (Fibonacci hashing,
    linear probing: Knuth, volume 3, section 6.4)."""
    slot = (vertex * 2654435769 & LAST) >> (32 - bits)
    while table[slot] >= 0 and pairs[table[slot]] >> 32 != vertex:
        slot = (slot + 1) & ((1 << bits) - 1)
    return slot


@compiled
def _scatter(pairs, begin, valence, first, m, at, slot, vertices, neighbours):
    """Scatter each closed ring into its batch.

    m[n] rings have valence n; their vertices begin at at[n] in `vertices`, their (n, m) neighbours
    at slot[n] in `neighbours`; both advance.
    """
    for v in range(len(valence)):
        n = valence[v]
        if n > 0:
            vertices[at[n]] = first + v
            at[n] += 1
            start, place, step = begin[v], slot[n], m[n]
            slot[n] = place + 1
            for i in range(n):
                neighbours[place + i * step] = pairs[start + i] >> 32
