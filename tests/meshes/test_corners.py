"""Rings walked around vertices: against an independent walk, in bounded time, within int32."""

import time

import numpy as np
import pytest

import curvlib
from curvlib.meshes import corners
from curvlib.meshes.corners import MANY, one_rings


def walked(faces, total):
    """Closed one-rings by dictionaries: vertex -> neighbours, from the lowest on."""
    following = {}
    for face in faces.tolist():
        if len(set(face)) == 3:
            for a, b, c in (face, face[1:] + face[:1], face[2:] + face[:2]):
                following.setdefault(a, []).append((b, c))
    rings = {}
    for vertex, pairs in following.items():
        after = dict(pairs)
        if len(after) < len(pairs) or len(pairs) < 3 or set(after) != set(after.values()):
            continue
        ring = [min(after)]
        while after[ring[-1]] != ring[0]:
            ring.append(after[ring[-1]])
        if len(ring) == len(pairs):
            rings[vertex] = ring
    return rings


def found(faces, total, threads=1):
    rings = {}
    for vertices, neighbours in one_rings(faces, total, threads):
        assert vertices.dtype == neighbours.dtype == np.int32
        for vertex, ring in zip(vertices.tolist(), neighbours.T.tolist()):
            assert vertex not in rings
            start = ring.index(min(ring))
            rings[vertex] = ring[start:] + ring[:start]
    return rings


def fan(n, stride=1):
    """A closed disk of n triangles around vertex 0, whose rim has every stride-th index."""
    rim = 1 + stride * np.arange(n)
    return np.column_stack((np.zeros(n, int), rim, np.roll(rim, -1))), 1 + stride * n


@pytest.mark.parametrize("seed", range(20))
def test_against_an_independent_walk(seed):
    """Random triangles on few vertices: open, doubled, turned, crossing and repeated corners."""
    rng = np.random.default_rng(seed)
    sphere = curvlib.tessellate(curvlib.surface("sphere"), 6, "random", seed=seed)
    total = len(sphere.vertices)
    new = rng.integers(total, size=total) if seed % 2 else rng.permutation(total)
    faces = np.vstack((new[sphere.faces], rng.integers(total, size=(seed, 3))))
    faces = rng.permutation(faces)
    assert found(faces, total) == walked(faces, total)


@pytest.mark.parametrize("n", [3, MANY - 1, MANY, MANY + 1, 1000])
@pytest.mark.parametrize("stride", [1, 64, 4096])
def test_valences_on_both_sides_of_the_table(n, stride):
    faces, total = fan(n, stride)
    faces = np.random.default_rng(n).permutation(faces)
    assert found(faces, total) == walked(faces, total) != {}
    for broken in (faces[1:], np.vstack((faces, faces[:1])), np.vstack((faces, [[0, 1, total]]))):
        assert found(broken, total + 1) == {}
    # Two disks that share the vertex in the middle.
    twice = np.vstack((faces, np.where(faces == 0, 0, faces + total)))
    assert found(twice, 2 * total) == {}


def test_a_fan_of_many_triangles_takes_time_by_its_size():
    def seconds(n):
        faces, total = fan(n)
        start = time.process_time()
        (batch,) = one_rings(faces, total)
        assert batch[1].shape == (n, 1)
        return time.process_time() - start

    seconds(1000)
    assert min(seconds(100_000) for _ in range(3)) < 1  # all pairs with all: 10^10 steps


def test_memory_does_not_grow_with_vertices_and_valence(monkeypatch):
    """A vertex of large valence in each bucket needs room for its own ring alone."""
    asked = []
    table = corners.table_of
    monkeypatch.setattr(corners, "table_of", lambda v: asked.append(len(table(v))) or table(v))
    monkeypatch.setattr(corners, "SHIFT", 8)
    count = 20
    faces = np.vstack([fan(100)[0] + k * 256 for k in range(count)])
    assert len(found(faces, 256 * count)) == count
    assert len(asked) == count
    assert 0 < max(asked) <= 500


def test_faces_that_name_a_vertex_twice_are_left_out():
    sphere = curvlib.tessellate(curvlib.surface("sphere"), 9, "random", seed=1)
    total, (a, b, c) = len(sphere.vertices), sphere.faces.T
    nothing = np.vstack([np.column_stack(x) for x in ((a, b, b), (a, a, c), (b, c, b), (a, a, a))])
    faces = np.random.default_rng(2).permutation(np.vstack((sphere.faces, nothing)))
    assert found(faces, total) == walked(sphere.faces, total)
    assert len(found(faces, total)) == total


def test_any_number_of_threads_gives_the_same_bytes(monkeypatch):
    monkeypatch.setattr(corners, "PART", 100)
    monkeypatch.setattr(corners, "SHIFT", 5)
    sphere = curvlib.tessellate(curvlib.surface("sphere"), 20, "random", seed=1)
    one, four = (one_rings(sphere.faces, len(sphere.vertices), n) for n in (1, 4))
    assert len(one) == len(four)
    for a, b in zip(one, four):
        np.testing.assert_array_equal(a[0], b[0])
        np.testing.assert_array_equal(a[1], b[1])


def test_one_machine_code_for_arrays_that_may_and_may_not_be_written_to():
    faces, total = fan(5)
    one_rings(faces, total)
    before = len(getattr(corners._deal, "signatures", []))
    faces.flags.writeable = False
    assert found(faces, total) == walked(faces, total)
    assert len(getattr(corners._deal, "signatures", [])) == before


def test_a_face_without_a_vertex_is_refused():
    faces, total = fan(5)
    for wrong in (-1, total):
        for place in range(3):
            changed = faces.copy()
            changed[3, place] = wrong
            with pytest.raises(curvlib.InputError, match="no vertex"):
                one_rings(changed, total)
