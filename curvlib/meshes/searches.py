"""Breadth-first search in the adjacency of a mesh.

Only vertices whose triangles form one disk or, on the boundary, one half-disk are walked through:
a search does not pass from one sheet to another where they meet in a vertex or in an edge of more
than two faces.
"""

import numpy as np

from curvlib.kit.compiled import kernel
from curvlib.kit.disk import MOST
from curvlib.kit.wider import append_row


@kernel
def k_rings(offsets, neighbours, v, rings, stamps, found, hops):
    """Breadth-first search from v: the number of vertices within `rings` edges of it.

    Parameters
    ----------
    offsets, neighbours
        Of an Adjacency.
    v, rings : int
    stamps : (V,) int32
        Zeros, or of searches from other vertices; v + 1 marks who was found.
    found : (MOST + widest + 1,) int32
        Set to the vertices: ring by ring, and within a ring as the rows of the one before name
        them.
    hops : as long, uint8
        Set to their distance from v in edges.

    Returns
    -------
    int
        At most MOST, or the valence of v; see MOST.
    """
    mark, count, begin = np.int32(v + 1), 0, 0
    stamps[v] = mark
    for j in range(offsets[v], offsets[v + 1]):
        found[count], hops[count] = neighbours[j], 1
        stamps[np.uint64(neighbours[j])] = mark
        count += 1
    for hop in range(2, rings + 1):
        end = count
        for i in range(begin, end):
            count = append_row(offsets, neighbours, np.uint64(found[i]), mark, stamps, found, count)
            if count > MOST:
                return end
        for i in range(end, count):
            hops[i] = hop
        begin = end
    return count


@kernel
def within(offsets, neighbours, vertices, v, radius, stamps, found, hops):
    """As `k_rings`, for the vertices no farther than `radius` from v that are connected to it by
    edges between such vertices. -1 where `found` is too short."""
    mark, count, at, u, hop = np.int32(v + 1), 0, 0, v, 1
    stamps[v] = mark
    x, y, z = vertices[v, 0], vertices[v, 1], vertices[v, 2]
    while True:
        if count + offsets[u + 1] - offsets[u] > len(found):
            return -1
        for j in range(offsets[u], offsets[u + 1]):
            w = np.uint64(neighbours[j])
            if stamps[w] != mark:
                # Marked also where it is too far, to be looked at once.
                stamps[w] = mark
                a = (vertices[w, 0] - x) / radius
                b = (vertices[w, 1] - y) / radius
                c = (vertices[w, 2] - z) / radius
                if a * a + b * b + c * c <= 1:
                    found[count], hops[count] = w, hop
                    count += 1
        if at == count:
            return count
        u, hop = found[at], min(hops[at] + 1, 255)
        at += 1
