"""From faces to one-rings: their corners, sorted by vertex and walked around each.

A corner is a vertex of a face with the two that follow it there. Corners are dealt out to
buckets of consecutive vertices first, so that sorting and walking stay in cache, however the
faces come; parts of the faces, and buckets, are independent of each other.
"""

import numpy as np

from .compiled import compiled

# From this valence on the next corner is found by a table, not by looking at all.
MANY = 64


@compiled
def count(faces, shift, counts):
    """Add to counts (buckets,) the corners of faces (F, 3) that lie in each bucket."""
    for f in range(len(faces)):
        for c in range(3):
            counts[faces[f, c] >> shift] += 1


@compiled
def deal(faces, shift, places, corners):
    """Write corners (rows, 3), vertex, next and last, from places (buckets,) on; moves them."""
    for f in range(len(faces)):
        for c in range(3):
            v = faces[f, c]
            place = places[v >> shift]
            places[v >> shift] = place + 1
            corners[place, 0] = v
            corners[place, 1] = faces[f, (c + 1) % 3]
            corners[place, 2] = faces[f, (c + 2) % 3]


@compiled
def walk(corners, first, vertices, total):
    """One-rings of the `vertices` from `first` on, from their corners (rows, 3).

    Returns how many closed ones there are by valence, their vertices by rising valence, and
    their neighbours, of each valence n an (n, m), one after the other. `total`: of vertices in
    the mesh.
    """
    begin = np.zeros(vertices + 1, np.int32)
    for row in range(len(corners)):
        begin[corners[row, 0] - first + 1] += 1
    for v in range(vertices):
        begin[v + 1] += begin[v]
    here, there = np.empty(len(corners), np.int32), np.empty(len(corners), np.int32)
    place = begin.copy()
    for row in range(len(corners)):
        v = corners[row, 0] - first
        here[place[v]], there[place[v]] = corners[row, 1], corners[row, 2]
        place[v] += 1

    valence = np.zeros(vertices, np.int32)
    table = np.zeros(0, np.int32)
    for v in range(vertices):
        start, end = begin[v], begin[v + 1]
        if end - start < 3:
            continue
        if end - start < MANY:
            closed = _sort(here, there, start, end)
        else:
            if len(table) == 0:
                table = np.full(total, -1, np.int32)
            closed = _sort_by_table(here, there, start, end, table)
        if closed:
            valence[v] = end - start

    rings = np.zeros(max(3, valence.max() if vertices else 0) + 1, np.int32)
    for v in range(vertices):
        rings[valence[v]] += 1
    rings[0] = 0
    # Of each valence: where its vertices, and where its neighbours begin.
    at, neighbours_at = np.zeros(len(rings), np.int64), np.zeros(len(rings), np.int64)
    for n in range(1, len(rings)):
        at[n] = at[n - 1] + rings[n - 1]
        neighbours_at[n] = neighbours_at[n - 1] + (n - 1) * rings[n - 1]
    order = np.empty(rings.sum(), np.int32)
    neighbours = np.empty(neighbours_at[-1] + (len(rings) - 1) * rings[-1], np.int32)
    found = np.zeros(len(rings), np.int64)
    for v in range(vertices):
        n = valence[v]
        if n > 0:
            k = found[n]
            found[n] = k + 1
            order[at[n] + k] = first + v
            for i in range(n):
                neighbours[neighbours_at[n] + i * rings[n] + k] = here[begin[v] + i]
    return rings, order, neighbours


@compiled
def _sort(here, there, start, end):
    """Bring the corners of a vertex in the order of a walk; whether it came by all and back."""
    for i in range(start, end - 1):
        if there[i] == here[start]:
            return False
        after = _find(there[i], here, i + 1, end)
        if after == end or _find(there[i], here, after + 1, end) < end:
            return False
        here[after], here[i + 1] = here[i + 1], here[after]
        there[after], there[i + 1] = there[i + 1], there[after]
    return there[end - 1] == here[start]


@compiled
def _find(vertex, here, start, end):
    """The first place from `start` on of a vertex; `end` if there is none before."""
    while start < end and here[start] != vertex:
        start += 1
    return start


@compiled
def _sort_by_table(here, there, start, end, table):
    """As `_sort`, by a table of -1 for each vertex, in which each neighbour has its corner."""
    n = end - start
    walked = np.empty(n, np.int32)
    for i in range(start, end):
        table[here[i]] = i
    i, steps = start, 0
    while steps < n and i >= 0 and (steps == 0 or i != start):
        walked[steps] = here[i]
        steps += 1
        i = table[there[i]]
    for j in range(start, end):
        table[here[j]] = -1
    closed = steps == n and i == start
    if closed:
        here[start:end] = walked
    return closed
