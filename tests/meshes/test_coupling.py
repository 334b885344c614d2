"""Fields that are solutions of equations between vertices: against a dense solution."""

import itertools
from typing import Literal

import numpy as np
import pytest

import curvlib
from curvlib.kit.coupled import Coupled


def solved(disk, start, strength: Literal[1, 2, 9] = 1) -> Coupled:
    """u and v are pulled to those of the neighbours, the more the nearer they are."""
    rows, n = disk.rows, disk.count
    for i in range(n):
        x, y, z = disk.e[0, i], disk.e[1, i], disk.e[2, i]
        pull = 0.4 * strength / (n * (1 + x * x + y * y + z * z))
        rows[10, i], rows[11, i], rows[12, i], rows[13, i] = pull, 0.2 * pull, -0.3 * pull, pull
        rows[14, i], rows[15, i] = x, y
    own = start[0, 0], start[1, 0]
    return Coupled(own, (start[2, 0],), (start[3, 0],), rows[10:16], n if start[3, 0] > 0 else 0)


def start(disk):
    N = disk.normal
    return N[0] / 4, N[1] / 4, N[2], 1.0 if disk.closed else 0.0


def estimate(disk, solved, strength: Literal[1, 2, 9] = 1):
    """Two components at a time: u, v; then the other and the constant; then the change."""
    return solved[0, 0], solved[1, 0]


def others(disk, solved, strength: Literal[1, 2, 9] = 1):
    return solved[2, 0], solved[3, 0]


def changes(disk, solved, strength: Literal[1, 2, 9] = 1):
    return solved[4, 0], 0.0


def dense(mesh, strength):
    """u, v, the other and the constant of every vertex; NaN without a disk."""
    count = len(mesh.vertices)
    offsets, neighbours, stars, _ = mesh.find_adjacency()
    n = curvlib.estimate(mesh, lambda disk: (disk.normal[0], disk.normal[1]))
    third = curvlib.estimate(mesh, lambda disk: (disk.normal[2], 0.0)).K
    matrix, far = np.eye(2 * count), np.zeros((count, 2 * count))
    for v in range(count):
        row = neighbours[offsets[v] : offsets[v + 1]]
        if stars[v] != 1:
            continue
        e = (mesh.vertices[row] - mesh.vertices[v]) * mesh.unit
        pull = 0.4 * strength / (len(row) * (1 + (e * e).sum(1)))
        for w, p, x in zip(row, pull, e):
            matrix[2 * v : 2 * v + 2, 2 * w : 2 * w + 2] -= p * np.array([[1, 0.2], [-0.3, 1]])
            far[v, 2 * w : 2 * w + 2] += x[:2]
    own = np.column_stack((n.K / mesh.unit**2, n.H / mesh.unit))
    own = np.nan_to_num(own) / 4
    x = np.linalg.solve(matrix, own.reshape(-1))
    return x.reshape(-1, 2), third / mesh.unit**2 + far @ x, (stars == 1).astype(float), stars


@pytest.fixture(scope="module")
def mesh():
    return curvlib.tessellate(curvlib.surface("revolution"), 8, "random", seed=2)


def values(mesh, function, **options):
    found = curvlib.estimate(mesh, function, **options)
    return found.K / mesh.unit**2, found.H / mesh.unit


def test_against_a_dense_solution(mesh):
    """To the tolerance of sweeps, 1e-3 of the first change."""
    x, other, constant, _ = dense(mesh, 1)
    u, v = values(mesh, estimate)
    size = np.abs(x).max()
    np.testing.assert_allclose(u, x[:, 0], atol=1e-2 * size)
    np.testing.assert_allclose(v, x[:, 1], atol=1e-2 * size)
    found, constants = values(mesh, others)
    np.testing.assert_allclose(found, other, atol=0.05 * np.abs(other).max())
    np.testing.assert_array_equal(constants, constant)


def test_any_number_of_threads_and_blocks(mesh, monkeypatch):
    alone = values(mesh, estimate)
    for block, threads in ((7, 1), (7, 5), (2048, 2)):
        monkeypatch.setattr("curvlib.meshes.loops.BLOCK", block)
        for a, b in zip(alone, values(mesh, estimate, threads=threads)):
            np.testing.assert_array_equal(a, b)


def test_equations_without_a_stable_solution(mesh):
    """Unknowns stay bounded, and the change of the last sweep tells."""
    u, v = values(mesh, estimate, strength=9)
    assert np.hypot(u, v).max() < 1 + 1e-12
    assert values(mesh, changes, strength=9)[0].max() > 1e-3
    assert values(mesh, changes)[0].max() < 1e-3


def test_no_disk():
    """Each edge of all triangles on five points has three of them."""
    points = np.random.default_rng(1).normal(size=(5, 3))
    broken = curvlib.Mesh(points, list(itertools.combinations(range(5), 3)))
    found = curvlib.estimate(broken, estimate)
    assert np.isnan(found.K).all()
