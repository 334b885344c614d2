"""Creases: the edges along which smooth pieces of a surface meet at an angle."""

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.parallel import for_each

from .arrays import frozen
from .bends import normals_beside, scores, turn_about
from .mend import connected
from .neighbourhoods import CLOSED
from .roughness import noise, staircase

# So many edges are tested of any mesh, and one of at most so many of a larger one; besides those
# that turn by more than this, in radians, and by this many times the median.
FIRST, FEWER = 8192, 12
SHARP, OUTSTANDING = 0.35, 4.0
# A crease begins at an edge of the first score, and goes on over edges of the second.
SURE, LIKELY = 25.0, 5.0
# A vertex may lie so many mean edges off: a part of a mesh that is as small has no crease.
TINY = 3e-3
# It has so many edges of the first score.
LEAST = 4
# At its end it goes on over up to so many edges that turn by this part of its last turn or more, to
# within the angle of this cosine.
MORE, PART, AHEAD = 4, 0.5, 0.5
BLOCK = 4096


def creases(mesh, threads: int = 1) -> np.ndarray:
    """The edges at which a surface bends without being curved there: its normal turns out of
    proportion to the curvature on either side, as the vertices tell it.

    Parameters
    ----------
    mesh : Mesh
    threads : int
        Edges do not depend on it.

    Returns
    -------
    ndarray of int32, (n, 2)
        Their ends, the smaller first, in ascending order.

    Notes
    -----
    At an edge two polynomials are compared with one (`curvlib.meshes.bends`): a crease begins where
    they are 25 times better, goes on where they are 5 times better, and at corners, where a third
    piece is near, along edges that turn as it does. So a rounded edge is none, nor a place where
    curvature alone jumps, nor the edges of a coarse sphere. Smooth surfaces have scores below 7 at
    any resolution, white noise of up to 0.2 mean edges below 4. Edges of 90 degrees are found in
    noise of up to 0.03 mean edges. Steps of voxels (`curvlib.meshes.roughness.staircase`) are no
    creases. Of large meshes one edge of twelve is tested, those that turn by more than 20 degrees
    and four times the median, and those around each that is found: a crease of 50 edges that turn
    less is missed by a chance of 1 %. Each side needs 9 vertices within two edges.
    Of the families of meshes (`curvlib.families`) of 12 to 50 cells smooth ones have none, but for
    coarse tori that are stretched 1:10: 6 % of the edges at 12 cells, 0.6 % at 25. Voxels of a body
    with flat sides are a block.
    """
    offsets, neighbours, stars, _ = mesh.find_adjacency(threads)
    vertices = frozen(mesh.vertices * mesh.unit)
    edges, turns = np.empty((len(neighbours), 4), np.int32), np.empty(len(neighbours))
    count = _inner_edges(vertices, offsets, neighbours, stars, edges, turns)
    edges, turns = edges[:count], turns[:count]
    sharpest = np.zeros(len(vertices))
    _largest(edges, turns, sharpest)
    given, least = (vertices, offsets, neighbours, sharpest), TINY * mesh.mean_edge * mesh.unit

    def score(some):
        def block(start):
            part = some[start : start + BLOCK]
            found, places = np.empty(len(part)), np.empty(len(vertices), np.int32)
            memory = np.zeros(len(vertices), np.int32), places
            scores(given, edges[part], turns[part], least, memory, found)
            return found

        return np.concatenate([np.empty(0), *for_each(block, range(0, len(some), BLOCK), threads)])

    step = min(max(1, count // FIRST), FEWER)
    tested = np.zeros(count, bool)
    tested[::step] = True
    sharp = max(SHARP, OUTSTANDING * np.median(np.abs(turns[::step]))) if count else SHARP
    tested |= np.abs(turns) > sharp
    some, sure = np.flatnonzero(tested), np.zeros(count, bool)
    found = some[score(some) > SURE]
    sure[found] = True
    none = np.empty((0, 2), np.int32)
    if not len(found):
        return none
    ends = edges[:, :2]
    steps = vertices[ends[:, 0]] - vertices[ends[:, 1]]
    # Noise is costly: it is asked for where steps are few.
    if staircase(steps, np.inf) and staircase(steps, noise(mesh)):
        return none
    around = _Around(ends, len(vertices))
    on, seen = np.zeros(count, bool), np.zeros(count, bool)
    on[found] = seen[found] = True
    while len(found):
        near = np.unique(around.edges_at(np.unique(ends[found])))
        near = near[~seen[near]]
        seen[near] = True
        better = score(near)
        sure[near[better > SURE]] = True
        found = near[better > LIKELY]
        on[found] = True
    _go_on(vertices, ends, turns, on, around)
    return np.unique(np.sort(ends[on & _long(ends, on, sure)], axis=1), axis=0)


class _Around:
    """The edges at each vertex, as compressed sparse rows."""

    def __init__(self, ends, total):
        self.offsets = np.zeros(total + 1, np.int64)
        np.cumsum(np.bincount(ends.reshape(-1), minlength=total), out=self.offsets[1:])
        self.rows = np.empty(ends.size, np.int32)
        _deal(ends, self.offsets[:-1].copy(), self.rows)

    def edges_at(self, vertices):
        rows = [self.rows[self.offsets[v] : self.offsets[v + 1]] for v in vertices.tolist()]
        return np.concatenate(rows)


@compiled
def _deal(ends, places, rows):
    for k in range(len(ends)):
        for c in range(2):
            rows[places[ends[k, c]]] = k
            places[ends[k, c]] += 1


def _go_on(vertices, ends, turns, on, around):
    """Lengthen creases that end, over edges that turn as their last one does."""
    places, uses = np.unique(ends[on], return_counts=True)
    number = dict(zip(places.tolist(), uses.tolist()))
    for tip in places[uses == 1].tolist():
        at = around.edges_at(np.array([tip]))
        last = int(at[on[at]][0])
        for _ in range(MORE):
            at = around.edges_at(np.array([tip]))
            back = vertices[tip] - vertices[ends[last].sum() - tip]
            steps = vertices[ends[at].sum(1) - tip] - vertices[tip]
            lengths = np.linalg.norm(steps, axis=1) * np.linalg.norm(back)
            same = turns[at] * np.sign(turns[last]) > max(PART * abs(turns[last]), SHARP)
            same &= ~on[at] & (steps @ back > AHEAD * lengths)
            if not same.any():
                break
            last = int(at[same][np.abs(turns[at[same]]).argmax()])
            on[last] = True
            tip = int(ends[last].sum() - tip)
            number[tip] = number.get(tip, 0) + 1
            if number[tip] > 1:
                break


def _long(ends, on, sure):
    """(E,) bool: an edge of those `on` is connected by them with LEAST or more that are `sure`."""
    count = int(ends.max()) + 1
    piece = connected(ends[on], count)
    enough = np.bincount(piece[ends[sure][:, 0]], minlength=count) >= LEAST
    return enough[piece[ends[:, 0]]]


@compiled
def _inner_edges(vertices, offsets, neighbours, stars, edges, turns):
    """Edges (E, 4) between two triangles: their ends, and the vertices opposite on the left and on
    the right; turns (E,) of the normal there, in radians, positive where the surface bends away
    from it. Returns how many there are."""
    count = 0
    for v in range(len(stars)):
        first, n = offsets[v], offsets[v + 1] - offsets[v]
        ends = 0 if stars[v] == CLOSED else 1
        for j in range(ends, n - ends):
            w = neighbours[first + j]
            # Of a vertex whose triangles form no disk there is no row.
            if w < v and offsets[w + 1] > offsets[w]:
                continue
            x, y = neighbours[first + (j + 1) % n], neighbours[first + (j - 1) % n]
            edges[count, 0], edges[count, 1], edges[count, 2], edges[count, 3] = v, w, x, y
            left, right, along = normals_beside(vertices, v, w, x, y)
            turns[count] = turn_about(right, left, along)
            count += 1
    return count


@compiled
def _largest(edges, turns, sharpest):
    """Set sharpest (V,), zeros before, to the largest turn of the edges at each vertex."""
    for k in range(len(edges)):
        for c in range(2):
            sharpest[edges[k, c]] = max(sharpest[edges[k, c]], abs(turns[k]))
