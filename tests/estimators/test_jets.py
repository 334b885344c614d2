"""Jets through the vertex: rings that are added, and errors beside those of approximation."""

from typing import Literal

import numpy as np
import pytest
from test_fits import exact, graph, wavy

import curvlib
from curvlib.kit.wider import wider
from curvlib.meshes.torus import torus


def grown(disk, rings: Literal[1, 2, 3, 4] = 1, more: Literal[0, 1, 2] = 0):
    for _ in range(more):
        disk, _ = wider(disk)
    total = 0.0
    for i in range(disk.count):
        total += disk.hops[i] * (1 + disk.e[0, i] + 2 * disk.e[1, i] + 3 * disk.e[2, i])
    return disk.count + total, disk.radius


@pytest.mark.parametrize("rings", [1, 2])
@pytest.mark.parametrize("more", [1, 2])
def test_a_wider_disk_is_that_of_more_rings(rings, more):
    mesh = curvlib.tessellate(curvlib.surface("revolution"), 12, "random", seed=2)
    found = curvlib.estimate(mesh, grown, rings=rings, more=more)
    expected = curvlib.estimate(mesh, grown, rings=rings + more)
    np.testing.assert_array_equal(found.K, expected.K)
    np.testing.assert_array_equal(found.H, expected.H)


def test_a_disk_stays_where_there_is_no_ring_or_too_wide_a_one():
    n = 1025
    angle = 2 * np.pi * np.arange(n) / n
    rim = np.column_stack((np.cos(angle), np.sin(angle), 0 * angle))
    k = np.arange(n)
    fan = np.vstack((rim, [[0, 0, 0.1]])), np.column_stack((k, (k + 1) % n, np.full(n, n)))
    for mesh in (fan, ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])):
        for value, expected in zip(
            curvlib.estimate(mesh, grown, more=2), curvlib.estimate(mesh, grown)
        ):
            np.testing.assert_array_equal(value, expected)


def errors(found, K, H, part):
    return np.array([np.abs(found.K - K)[part].mean(), np.abs(found.H - H)[part].mean()])


def test_degree_6_over_3_rings_beside_approximation_of_degree_4():
    """One fifteenth of the error on a torus, one fortieth on a graph, one third at its boundary,
    corners included."""
    vertices, faces = torus(64, "irregular", seed=4)
    around = np.hypot(vertices[:, 0], vertices[:, 1])
    k2 = (around - 2) / around
    every = np.ones(len(vertices), bool)
    mesh = graph(50, wavy, seed=4)
    x, y, _ = mesh.vertices.T
    edge = mesh.boundary
    for given, K, H, part, ratio in (
        ((vertices, faces), k2, (1 + k2) / 2, every, 15),
        (mesh, *exact(x, y, wavy), ~edge, 40),
        (mesh, *exact(x, y, wavy), edge, 3),
    ):
        fine = curvlib.estimate(given, "jet", degree=6, rings=3)
        plain = curvlib.estimate(given, "jet", degree=4, rings=3, fit="approximation")
        assert (ratio * errors(fine, K, H, part) < errors(plain, K, H, part)).all()


def test_low_valences():
    """All but the vertices of a coarse mesh have valence 3 or about 12: each triangle is split
    twice at its centre. Degree 6 is determined within five rings."""
    mesh = graph(33, lambda x, y: 0.0 * x)
    points, faces = mesh.vertices, mesh.faces
    for _ in range(2):
        centres = points[faces].mean(1)
        new = len(points) + np.arange(len(faces))
        a, b, c = faces.T
        faces = np.vstack([np.column_stack(t) for t in ((a, b, new), (b, c, new), (c, a, new))])
        points = np.vstack((points, centres))
    x, y = points[:, 0], points[:, 1]
    found = curvlib.estimate((np.column_stack((x, y, wavy(x, y))), faces), "jet", degree=6, rings=2)
    K, H = exact(x, y, wavy)
    assert np.isfinite(found.K).all()
    inner = (np.abs(x) < 0.8) & (np.abs(y) < 0.8)
    assert np.abs(found.K - K)[inner].max() < 0.02
    assert np.abs(found.H - H)[inner].max() < 0.02
