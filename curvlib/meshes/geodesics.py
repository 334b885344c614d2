"""Who is within some length of a vertex along edges: Dijkstra's algorithm, bounded."""

import numpy as np

from curvlib.kit.compiled import kernel

from .walks import LAST


@kernel
def along_edges(offsets, neighbours, vertices, v, radius, memory):
    """Find the vertices to which a path of edges from v is at most `radius` long.

    Parameters
    ----------
    offsets, neighbours
        Of an Adjacency.
    vertices : (V, 3)
    v : int
    radius : float
    memory : tuple
        `marks` (V,) int64, zeros, or of searches from other vertices; `found` int32, `hops` uint8
        and `distances`, all of one length or more; `keys` and `slots` int32, of one length; `who`
        int32, `lengths` and `edges` uint8, of the length of `found`.

    Returns
    -------
    int
        The number of vertices, v not counted. They are in `found`, from the nearest on, with the
        length of their shortest path in `distances` and the number of its edges, at most 255, in
        `hops`. -1 where the memory does not suffice.
    """
    marks, found, hops, distances, keys, slots, who, lengths, edges = memory
    mark, reached, count, size = np.int64(v + 1) << 32, 1, 0, 1
    marks[v], who[0], lengths[0], edges[0] = mark, v, 0.0, 0
    keys[0], slots[0] = 0.0, 0
    while size > 0:
        length, slot = keys[0], slots[0]
        size -= 1
        _sink(keys, slots, size)
        if length > lengths[slot]:  # a shorter path was found after this one
            continue
        u = np.int64(who[slot])
        if slot > 0:
            found[count], hops[count], distances[count] = u, edges[slot], length
            count += 1
        for j in range(offsets[u], offsets[u + 1]):
            w = np.int64(neighbours[j])
            square = 0.0
            for c in range(3):
                difference = (vertices[w, c] - vertices[u, c]) / radius
                square += difference * difference
            longer = length + np.sqrt(square) * radius
            if not longer <= radius:
                continue
            if marks[w] >> 32 << 32 != mark:
                if reached == len(found):
                    return -1
                marks[w], who[reached] = mark | reached, w
                reached += 1
            elif longer >= lengths[marks[w] & LAST]:
                continue
            at = marks[w] & LAST
            lengths[at], edges[at] = longer, min(edges[slot] + 1, 255)
            if size == len(keys):
                return -1
            _raise(keys, slots, size, longer, at)
            size += 1
    return count


@kernel
def _raise(keys, slots, k, key, slot):
    """Insert at the end of a heap of k entries; of equal keys the smaller slot is nearer the top,
    so that the order does not depend on that of insertions."""
    while k > 0:
        above = (k - 1) // 2
        if not (key < keys[above] or (key == keys[above] and slot < slots[above])):
            break
        keys[k], slots[k] = keys[above], slots[above]
        k = above
    keys[k], slots[k] = key, slot


@kernel
def _sink(keys, slots, size):
    """Remove the top of a heap; its last entry, at `size`, takes a new place."""
    key, slot, k = keys[size], slots[size], 0
    while 2 * k + 1 < size:
        below = 2 * k + 1
        if below + 1 < size and (
            keys[below + 1] < keys[below]
            or (keys[below + 1] == keys[below] and slots[below + 1] < slots[below])
        ):
            below += 1
        if not (keys[below] < key or (keys[below] == key and slots[below] < slot)):
            break
        keys[k], slots[k] = keys[below], slots[below]
        k = below
    keys[k], slots[k] = key, slot
