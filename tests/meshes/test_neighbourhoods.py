"""Neighbourhoods: adjacency, rings and balls against independent searches."""

import time

import numpy as np
import pytest

import curvlib
from curvlib.kit.disk import MOST
from curvlib.meshes import corners
from curvlib.meshes.neighbourhoods import BROKEN, CLOSED, OPEN, adjacency
from curvlib.meshes.searches import k_rings, within
from curvlib.meshes.torus import torus
from curvlib.meshes.walks import MANY


def stars(faces, total):
    """Star and row of each vertex by dictionaries; a closed row from its lowest neighbour on."""
    pairs = [[] for _ in range(total)]
    for face in faces.tolist():
        if len(set(face)) == 3:
            for a, b, c in (face, face[1:] + face[:1], face[2:] + face[:2]):
                pairs[a].append((b, c))
    return [star(own) for own in pairs]


def star(pairs):
    after, ends = dict(pairs), {b for _, b in pairs}
    if not pairs or len(after) < len(pairs) or len(ends) < len(pairs):
        return BROKEN, []
    loose = set(after) - ends
    if len(loose) > 1 or (not loose and len(pairs) < 3):
        return BROKEN, []
    row = [min(loose or after)]
    while row[-1] in after and (len(row) == 1 or row[-1] != row[0]):
        row.append(after[row[-1]])
    if len(row) != len(pairs) + 1:
        return BROKEN, []
    return (OPEN, row) if loose else (CLOSED, row[:-1])


def found(faces, total, threads=1):
    offsets, neighbours, kinds, widest = adjacency(faces, total, threads)
    rows = [row.tolist() for row in np.split(neighbours, offsets[1:-1])] if total else []
    assert widest == max(map(len, rows), default=0)
    for v, row in enumerate(rows):
        if kinds[v] == CLOSED:
            start = row.index(min(row))
            rows[v] = row[start:] + row[:start]
    return list(zip(kinds.tolist(), rows))


@pytest.mark.parametrize("seed", range(20))
def test_adjacency_against_dictionaries(seed):
    """Random triangles on few vertices and a torn sphere: open, broken and repeated corners."""
    rng = np.random.default_rng(seed)
    sphere = curvlib.tessellate(curvlib.surface("sphere"), 6, "random", seed=seed)
    total = len(sphere.vertices)
    torn = sphere.faces[rng.random(len(sphere.faces)) < 0.9]
    faces = rng.permutation(np.vstack((torn, rng.integers(total, size=(seed, 3)))))
    assert found(faces, total) == stars(faces, total)
    assert {kind for kind, _ in stars(torn, total)} >= {CLOSED, OPEN}


@pytest.mark.parametrize("n", [1, 2, 3, MANY - 2, MANY - 1, MANY, MANY + 1, 1000])
def test_half_disks_of_any_valence(n):
    faces = np.column_stack((np.zeros(n, int), np.arange(1, n + 1), np.arange(2, n + 2)))
    faces = np.random.default_rng(n).permutation(faces)
    total = n + 2
    assert found(faces, total)[0] == (OPEN, [*range(1, total)])
    assert found(faces, total) == stars(faces, total)
    for wrong in (faces[:1], faces[:1, [0, 2, 1]], [[0, total, total + 1]]):
        worse = np.vstack((faces, wrong))
        assert found(worse, total + 2)[0] == (BROKEN, [])
        assert found(worse, total + 2) == stars(worse, total + 2)


def test_a_fan_of_many_triangles_takes_time_by_its_size():
    n = 200_000
    faces = np.column_stack((np.zeros(n, int), np.arange(1, n + 1), np.arange(2, n + 2)))
    adjacency(faces[:9], n + 2)
    start = time.process_time()
    assert adjacency(faces, n + 2).stars[0] == OPEN
    assert time.process_time() - start < 1


def test_meshes_without_faces_or_vertices():
    none = np.empty((0, 3), int)
    assert found(none, 0) == []
    assert found(none, 3) == [(BROKEN, [])] * 3
    assert found(np.array([[0, 1, 2]]), 5)[3:] == [(BROKEN, [])] * 2


def test_any_number_of_threads_gives_the_same_bytes(monkeypatch):
    monkeypatch.setattr(corners, "PART", 100)
    monkeypatch.setattr(corners, "SHIFT", 5)
    surface = curvlib.tessellate(curvlib.surface("revolution"), 20, "random", seed=1)
    one, four = (adjacency(surface.faces, len(surface.vertices), n) for n in (1, 4))
    for a, b in zip(one, four):
        np.testing.assert_array_equal(a, b)


def searched(rows, v, inside=lambda w: True):
    """Vertex -> distance in edges from v, over vertices `inside`."""
    distance, last = {v: 0}, [v]
    while last:
        last = [w for u in last for w in dict.fromkeys(rows[u]) if w not in distance and inside(w)]
        last = list(dict.fromkeys(last))
        distance |= dict.fromkeys(last, distance[v] + 1 + max(distance.values()))
    del distance[v]
    return distance


@pytest.fixture
def patch():
    """Of a jittered torus with a hole, and a vertex where two sheets meet."""
    vertices, faces = torus(16, "irregular")
    keep = (faces != 7).all(1) & (np.arange(len(faces)) != 300)
    return curvlib.Mesh(vertices, faces[keep])


@pytest.mark.parametrize("rings", [1, 2, 3, 4])
def test_rings_against_a_search_by_dictionaries(patch, rings):
    offsets, neighbours, kinds, widest = patch.find_adjacency()
    rows = [row.tolist() for row in np.split(neighbours, offsets[1:-1])]
    stamps = np.zeros(len(rows), np.int32)
    places = np.empty(MOST + widest + 1, np.int32)
    hops = np.empty(len(places), np.uint8)
    for v in np.flatnonzero(kinds):
        count = k_rings(offsets, neighbours, v, rings, stamps, places, hops)
        expected = {w: hop for w, hop in searched(rows, v).items() if hop <= rings}
        assert dict(zip(places[:count].tolist(), hops[:count].tolist())) == expected
        assert (np.diff(hops[:count].astype(int)) >= 0).all()
        np.testing.assert_array_equal(places[: len(rows[v])], rows[v])


@pytest.mark.parametrize("radius", [0.3, 1.0, 1.9])
def test_balls_against_a_search_by_dictionaries(patch, radius):
    """And, of two sheets, those of its own alone."""
    count = len(patch.vertices)
    vertices = np.vstack((patch.vertices, patch.vertices + np.array([0, 0, 0.01])))
    patch = curvlib.Mesh(vertices, np.vstack((patch.faces, patch.faces + count)))
    offsets, neighbours, kinds, _ = patch.find_adjacency()
    rows = [row.tolist() for row in np.split(neighbours, offsets[1:-1])]
    stamps = np.zeros(len(rows), np.int32)
    places, hops = np.empty(1000, np.int32), np.empty(1000, np.uint8)
    for v in np.flatnonzero(kinds):
        distance = np.linalg.norm(patch.vertices - patch.vertices[v], axis=1)
        search = offsets, neighbours, patch.vertices, v, radius
        count = within(*search, stamps, places, hops)
        expected = searched(rows, v, lambda w, d=distance: d[w] <= radius)
        assert dict(zip(places[:count].tolist(), hops[:count].tolist())) == expected
        assert (places[:count] // (len(rows) // 2) == v // (len(rows) // 2)).all()
        if count > 10:
            assert within(*search, np.zeros_like(stamps), places[:10], hops[:10]) == -1


def test_a_ring_of_too_many_is_left_out():
    """Around the hub of a wheel: its own ring is whole, and those of the rim end before it."""
    for n in (MOST - 3, MOST, 3 * MOST):
        k = np.arange(n)
        rim = np.column_stack((k, (k + 1) % n, np.full(n, n)))
        offsets, neighbours, _, widest = adjacency(rim, n + 1)
        stamps, places = np.zeros(n + 1, np.int32), np.empty(MOST + widest + 1, np.int32)
        hops = np.empty(len(places), np.uint8)
        assert k_rings(offsets, neighbours, n, 3, stamps, places, hops) == n
        expected = n if n <= MOST else 3
        assert k_rings(offsets, neighbours, 0, 3, stamps, places, hops) == expected


def test_mean_edge():
    for scale in (1.0, 1e-160, 1e160):
        vertices, faces = torus(12, "irregular")
        mesh = curvlib.Mesh(vertices * scale, faces)
        edges = np.vstack([faces[:, [a, b]] for a, b in ((0, 1), (1, 2), (2, 0))])
        lengths = np.linalg.norm(vertices[edges[:, 0]] - vertices[edges[:, 1]], axis=1)
        assert mesh.mean_edge / scale == pytest.approx(lengths.mean(), rel=1e-12)
