"""Walks around a vertex: its pairs ordered so that each ends where the next one starts.

A pair is packed into one integer as start * 2^32 + end.
"""

from curvlib.kit.compiled import compiled

LAST = (1 << 32) - 1
# From this valence on `walk_by_table` is faster, which takes O(n) time instead of O(n^2).
MANY = 64


@compiled
def walk(pairs):
    """Order the pairs of a vertex as a walk; whether that visits all and closes."""
    n, start = len(pairs), pairs[0] >> 32
    for i in range(1, n):
        vertex = pairs[i - 1] & LAST
        found = times = 0
        # All pairs that are left are looked at: fewer branches are mispredicted than by a search.
        for j in range(i, n):
            same = pairs[j] >> 32 == vertex
            found = j if same else found
            times += same
        if times != 1 or vertex == start:
            return False
        pairs[i], pairs[found] = pairs[found], pairs[i]
    return pairs[n - 1] & LAST == start


@compiled
def walk_by_table(pairs, table):
    """As `walk`, in O(n). The table maps a vertex to its pair, by open addressing; behind it the
    walk is collected, since the table refers to places in `pairs`."""
    n, bits = len(pairs), 1
    while 1 << bits < 2 * n:
        bits += 1
    walked = 1 << bits
    for slot in range(walked):
        table[slot] = -1
    for i in range(n):
        slot = slot_of(pairs[i] >> 32, pairs, table, bits)
        if table[slot] >= 0:
            return False
        table[slot] = i
    i = 0
    for step in range(n):
        table[walked + step] = pairs[i]
        i = table[slot_of(pairs[i] & LAST, pairs, table, bits)]
        if i < 0 or (i == 0) != (step == n - 1):
            return False
    for step in range(n):
        pairs[step] = table[walked + step]
    return True


@compiled
def slot_of(vertex, pairs, table, bits):
    """The slot of a vertex in a table of 2^bits, or the empty slot for it (Fibonacci hashing,
    linear probing: Knuth, volume 3, section 6.4)."""
    slot = (vertex * 2654435769 & LAST) >> (32 - bits)
    while table[slot] >= 0 and pairs[table[slot]] >> 32 != vertex:
        slot = (slot + 1) & ((1 << bits) - 1)
    return slot
