"""Displaced vertices: which are found, where they are put."""

import numpy as np
import pytest

import curvlib
from curvlib.kit.displaced import displaced, placed, suspects
from curvlib.meshes.jittered import jittered
from curvlib.passes import Passes

FAR = 5  # mean edges


def found(passes):
    suspected = np.flatnonzero(passes.field(suspects)[3] == 1)
    return suspected[passes.field(displaced, suspected)[3] == 1] if len(suspected) else suspected


def moved(mesh, part, along, seed):
    """The mesh with some vertices displaced, and which."""
    rng = np.random.default_rng(seed)
    far = np.sort(rng.choice(len(mesh.vertices), int(part * len(mesh.vertices)), replace=False))
    moves = mesh.normals[far] * rng.choice([-1, 1], (len(far), 1))
    if along == "any":
        moves = rng.standard_normal((len(far), 3))
        moves /= np.linalg.norm(moves, axis=1)[:, None]
    vertices = mesh.vertices.copy()
    vertices[far] += FAR * mesh.mean_edge * moves
    return mesh.moved(vertices), far


@pytest.mark.parametrize("along", ["normals", "any"])
@pytest.mark.parametrize("surface", ["torus", "ellipsoid", "patch"])
def test_displaced_vertices_are_found_and_no_others(surface, along):
    mesh, far = moved(jittered(surface, 40, 6), 0.01, along, 6)
    np.testing.assert_array_equal(found(Passes(mesh, 1)), far)


@pytest.mark.parametrize("sigma", [0, 0.05, 0.2])
@pytest.mark.parametrize("surface", ["torus", "ellipsoid", "patch"])
def test_noise_displaces_none(surface, sigma):
    mesh = jittered(surface, 40, 7)
    noise = np.random.default_rng(7).standard_normal(mesh.vertices.shape) * sigma * mesh.mean_edge
    assert not len(found(Passes(mesh.moved(mesh.vertices + noise), 1)))


def test_corners_apexes_and_creases_are_not_displaced():
    k, unit = np.arange(8), np.arange(9.0)
    rim = np.column_stack((np.cos(k * np.pi / 4), np.sin(k * np.pi / 4), 0 * k))
    pyramid = np.vstack((rim, [[0, 0, 1]])), np.column_stack((k, (k + 1) % 8, np.full(8, 8)))
    x, y = (a.ravel() for a in np.meshgrid(unit, unit))
    corner = np.add.outer(np.arange(8) * 9, np.arange(8)).ravel()
    faces = np.concatenate([corner[:, None] + (0, 1, 10), corner[:, None] + (0, 10, 9)])
    # A square grid, folded along its middle by a right angle.
    folded = np.column_stack((x, np.minimum(y, 4), np.maximum(y - 4, 0)))
    for mesh in (pyramid, (folded, faces)):
        assert not len(found(Passes(curvlib.Mesh(*mesh), 1)))


def test_they_are_put_on_the_surface():
    """To the fourth power of the edge: the fit there is of degree 4."""
    errors = []
    for n in (25, 50):
        exact = jittered("ellipsoid", n, 3)
        mesh, far = moved(exact, 0.01, "normals", 3)
        passes = Passes(mesh, 1)
        put = mesh.vertices[far] + passes.field(placed, far).T
        off = ((put / (1.0, 0.8, 0.6)) ** 2).sum(1) - 1
        errors.append(np.abs(off).max() / exact.mean_edge)
        # Along the normal: where they were, but for the tilt of the median of normals.
        assert np.linalg.norm(put - exact.vertices[far], axis=1).max() < 2 * exact.mean_edge
    assert errors[1] < 2e-3
    assert errors[1] < errors[0] / 8


def test_a_vertex_outside_its_ring_returns_to_its_middle():
    exact = jittered("torus", 40, 2)
    v, t = 700, exact.d1[700]
    vertices = exact.vertices.copy()
    vertices[v] += FAR * exact.mean_edge * t
    passes = Passes(exact.moved(vertices), 1)
    assert found(passes).tolist() == [v]
    put = vertices[v] + passes.field(placed, np.array([v]))[:, 0]
    ring = np.unique(exact.faces[(exact.faces == v).any(1)])
    middle = exact.vertices[ring[ring != v]].mean(0)
    assert np.linalg.norm(put - middle) < 0.3 * exact.mean_edge
