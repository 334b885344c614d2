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

from .walks import MANY, walk, walk_by_table

# 2^SHIFT vertices make a bucket, whose corners stay in cache. SHIFT is at most 16: places in a
# bucket are uint16.
SHIFT = 14
PART = 65536  # faces


def one_rings(faces, total, threads: int = 1):
    """Closed one-rings of the vertices of faces (F, 3): list of (vertices (m,), neighbours (n, m)),
    int32, in batches of equal valence n.

    `total`: the number of vertices; Mesh checks that int32 counts them and the corners. Raises
    InputError if a face refers to no vertex.
    """
    neighbours = np.empty(3 * len(faces), dtype=np.int32)

    def batches(first, own, pairs, begin, valence, rings):
        return list(_batches(pairs, begin, valence, rings, first, neighbours[own]))

    return [batch for found in by_bucket(faces, total, threads, batches) for batch in found]


def by_bucket(faces, total, threads, use) -> list:
    """[use(first, own, pairs, begin, valence, rings)] over the buckets of the faces' corners.

    `first` is the first vertex of the bucket, `own` its slice of all corners. The pairs of vertex
    first + v begin at begin[v]: ordered as a walk around it, of valence[v] pairs, where they close
    to one ring, else in any order, valence[v] being zero; rings[n] of them have valence n.
    """
    faces = _frozen(faces)
    parts = [slice(k, k + PART) for k in range(0, len(faces), PART)]
    counts = np.zeros((len(parts), (total >> SHIFT) + 1), dtype=np.intp)
    places = np.zeros(counts.size + 1, dtype=np.intp)
    owners = np.empty(3 * len(faces), dtype=np.uint16)
    pairs = np.empty(3 * len(faces), dtype=np.int64)
    proper = [None] * len(parts)

    def count(part):
        # First touch: each thread faults in its own pages before all threads scatter into them.
        own = slice(3 * parts[part].start, 3 * parts[part].stop)
        owners[own][::2048], pairs[own][::512] = 0, 0
        proper[part] = faces[parts[part]]
        twice = _count(proper[part], total, SHIFT, counts[part])
        # Mesh has checked its faces; without a copy the caller may have written to them since.
        if twice < 0:
            raise InputError("faces: changed since the mesh was made, to what is no vertex")
        if twice > 0:
            a, b, c = proper[part].T
            proper[part] = _frozen(proper[part][(a != b) & (b != c) & (c != a)])
            counts[part] = 0
            _count(proper[part], total, SHIFT, counts[part])

    def deal(part):
        _deal(proper[part], SHIFT, starts[part], owners, pairs)

    def close(bucket):
        first, own = bucket << SHIFT, slice(*ends[bucket : bucket + 2])
        some = min(1 << SHIFT, total - first)
        begin, valence = np.zeros(some + 1, np.uint32), np.empty(some, np.uint32)
        ordered, rings = np.empty(own.stop - own.start, np.int64), np.zeros(MANY, np.intp)
        largest = _walks(owners[own], pairs[own], begin, valence, ordered, rings)
        if largest >= MANY:
            rings = np.append(rings, np.zeros(largest + 1 - MANY, np.intp))
            _walks_by_table(ordered, begin, table_of(largest), valence, rings)
        return use(first, own, ordered, begin, valence, rings)

    for_each(count, range(len(parts)), threads)
    # Ordered by bucket, then by part, so that the corners of a vertex keep the order of the faces.
    counts.T.cumsum(out=places[1:])
    starts = places[:-1].reshape(counts.shape[::-1]).T.copy()
    for_each(deal, range(len(parts)), threads)
    ends = places[:: len(parts)] if parts else []
    return for_each(close, range(len(ends) - 1), threads)


def table_of(n):
    """Memory for `walk_by_table` of n pairs: fewer than 4 n slots, and n pairs."""
    return np.empty(5 * n, dtype=np.int64)


def _frozen(faces):
    """Read only as the faces of a Mesh: one array type, compiled once."""
    faces = faces.view()
    faces.flags.writeable = False
    return faces


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
def _count(faces, total, shift, counts):
    """Add the corners of faces (F, 3) per bucket to counts (buckets,). Returns the number of faces
    that name a vertex twice; -1 if an index is not in 0 ... total - 1."""
    most, twice = np.uint64(total), 0
    for f in range(len(faces)):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        # Unsigned, a negative index is a large one.
        if not (np.uint64(a) < most) & (np.uint64(b) < most) & (np.uint64(c) < most):
            return -1
        twice += (a == b) | (b == c) | (c == a)
        a, b, c = a >> shift, b >> shift, c >> shift
        if (a == b) & (b == c):
            # One addition waits for the one before: a third of them, half the time.
            counts[a] += 3
        else:
            counts[a] += 1
            counts[b] += 1
            counts[c] += 1
    return twice


@compiled
def _deal(faces, shift, places, owners, pairs):
    """Scatter vertices, relative to their bucket, and pairs of the corners, (corners,) each, from
    places (buckets,) on, which advance."""
    for f in range(len(faces)):
        a, b, c = faces[f, 0], faces[f, 1], faces[f, 2]
        x, y, z = a >> shift, b >> shift, c >> shift
        if (x == y) & (y == z):
            at_a = places[x]
            at_b, at_c = at_a + 1, at_a + 2
            places[x] = at_a + 3
        else:
            at_a, at_b, at_c = _next(places, x), _next(places, y), _next(places, z)
        owners[at_a], pairs[at_a] = a - (x << shift), b << 32 | c
        owners[at_b], pairs[at_b] = b - (y << shift), c << 32 | a
        owners[at_c], pairs[at_c] = c - (z << shift), a << 32 | b


@compiled
def _next(places, bucket):
    place = places[bucket]
    places[bucket] = place + 1
    return place


@compiled
def _walks(owners, pairs, begin, valence, ordered, rings):
    """Sort pairs by vertex and order those of each vertex as a walk around it.

    Sets `ordered` (corners,); `begin` (vertices + 1,), zeros before, to the first pair of each
    vertex there; and `valence` (vertices,), zero where the pairs do not close to one ring. Counts
    the rings by valence in rings (MANY,). Returns the largest number of pairs; those of MANY pairs
    and more are not closed.
    """
    for row in range(len(owners)):
        begin[owners[row] + np.uint32(1)] += 1
    for v in range(len(valence)):
        valence[v] = begin[v]
        begin[v + 1] += begin[v]
    # A counting sort; until a vertex is walked around, valence[v] is the place of its next pair.
    for row in range(len(owners)):
        v = owners[row]
        ordered[valence[v]] = pairs[row]
        valence[v] += 1
    largest = 0
    for v in range(len(valence)):
        own = ordered[begin[v] : begin[v + 1]]
        n = len(own)
        largest = n if n > largest else largest
        valence[v] = 0
        if 3 <= n < MANY and walk(own):
            valence[v] = n
            rings[n] += 1
    return largest


@compiled
def _walks_by_table(ordered, begin, table, valence, rings):
    """As `_walks` of the sorted pairs, where there are MANY and more."""
    for v in range(len(valence)):
        own = ordered[begin[v] : begin[v + 1]]
        n = len(own)
        if n >= MANY and walk_by_table(own, table):
            valence[v] = n
            rings[n] += 1


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
