"""Estimator `goldfeather_interrante`: against least squares for one vertex at a time, exact on
cubics, its order with exact normals and with those of triangles."""

import numpy as np
import pytest

import curvlib
from curvlib.catalogue import estimators
from curvlib.kit.disk import ROWS, SPACE, Disk
from curvlib.meshes.torus import torus

estimate = estimators.module("goldfeather_interrante").estimate


def of_disk(e, N, normals):
    """The estimator's Curvatures of neighbours e (n, 3) with normals, around a vertex with N."""
    count = len(e)
    width = -(-count // 8) * 8
    rows = np.zeros((ROWS, width))
    rows[:3, :count], rows[3, :count] = e.T, 1
    hops, radius = np.ones(width, np.uint8), np.linalg.norm(e, axis=1).max()
    field = np.zeros((3, 1 + width))
    field[:, 0], field[:, 1 : 1 + count] = N, np.transpose(normals)
    none, up = np.empty(0), (0.0, 0.0, 1.0)
    space = np.zeros(SPACE)
    own = none, up, up, 0.0, True, radius, count, rows, space, None
    disk = Disk(rows[:3], rows[3], hops, *own)
    return estimate(disk, field)


def by_least_squares(e, N, normals):
    """K, H and the axis of k1, from the rows of the paper; quadratic for fewer than three
    neighbours."""
    X = np.cross(N, [0.36, 0.48, 0.8])
    frame = np.array([X / np.linalg.norm(X), np.cross(N, X / np.linalg.norm(X)), N])
    size = np.linalg.norm(e, axis=1).max()
    rows, right = [], []
    for (x, y, z), (nx, ny, nz) in zip(e @ frame.T / size, normals @ frame.T):
        rows.append([x * x / 2, x * y, y * y / 2, x**3, x * x * y, x * y * y, y**3])
        rows.append([x, y, 0, 3 * x * x, 2 * x * y, y * y, 0])
        rows.append([0, x, y, 0, x * x, 2 * x * y, 3 * y * y])
        right += [z, -nx / nz, -ny / nz]
    rows = np.array(rows)[:, : 7 if len(e) > 2 else 3]
    a, b, c = np.linalg.lstsq(rows, right, rcond=None)[0][:3] / size
    _, axes = np.linalg.eigh([[-a, -b], [-b, -c]])
    return a * c - b * b, -(a + c) / 2, axes[:, 1] @ frame[:2]


def neighbours(mesh, v):
    """The other vertices of the faces at v."""
    found = np.unique(mesh.faces[(mesh.faces == v).any(1)])
    return found[found != v]


@pytest.mark.parametrize("kind", ["open", "closed"])
def test_against_least_squares_for_one_vertex(kind):
    if kind == "open":
        mesh = curvlib.tessellate(curvlib.surface("revolution"), 12, "random", seed=4)
    else:
        mesh = curvlib.Mesh(*torus(20, "irregular"))
    found = curvlib.estimate(mesh, "goldfeather_interrante")
    a, b, c = mesh.vertices[mesh.faces].swapaxes(0, 1)
    normals = np.zeros_like(mesh.vertices)
    for corner in mesh.faces.T:
        np.add.at(normals, corner, np.cross(b - a, c - a))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    for v, N in enumerate(normals):
        ring = neighbours(mesh, v)
        K, H, d1 = by_least_squares(mesh.vertices[ring] - mesh.vertices[v], N, normals[ring])
        assert found.K[v] == pytest.approx(K, rel=1e-7, abs=1e-9)
        assert found.H[v] == pytest.approx(H, rel=1e-7, abs=1e-9)
        assert abs(np.dot(found.d1[v], d1)) == pytest.approx(1, abs=1e-6)
    assert np.isfinite(found.d2).all()


CUBIC = np.array([0.7, -0.4, 0.2, 0.5, -1.1, 0.3, 0.9])


def points_on(coefficients, count, rng):
    """Neighbours of the origin on z = a x^2 / 2 + ..., and their unit normals."""
    angle = 2 * np.pi * (np.arange(count) + rng.uniform(-0.3, 0.3, count)) / count
    r = rng.uniform(0.3, 0.8, count)
    x, y = r * np.cos(angle), r * np.sin(angle)
    a, b, c, d, e, f, g = coefficients
    z = a * x * x / 2 + b * x * y + c * y * y / 2
    z += d * x**3 + e * x * x * y + f * x * y * y + g * y**3
    p = a * x + b * y + 3 * d * x * x + 2 * e * x * y + f * y * y
    q = b * x + c * y + e * x * x + 2 * f * x * y + 3 * g * y * y
    normals = np.column_stack((-p, -q, np.ones(count)))
    return np.column_stack((x, y, z)), normals / np.linalg.norm(normals, axis=1)[:, None]


def assert_curvatures_of(found, coefficients, turn, tolerance=1e-10):
    a, b, c = coefficients[:3]
    values, axes = np.linalg.eigh([[-a, -b], [-b, -c]])
    np.testing.assert_allclose(
        found[:4], [a * c - b * b, -(a + c) / 2, values[1], values[0]], rtol=tolerance
    )
    assert abs(np.dot(found.d1, turn[:, :2] @ axes[:, 1])) == pytest.approx(1, abs=tolerance)
    np.testing.assert_allclose(np.cross(found.d1, found.d2), turn[:, 2], atol=1e-12)


@pytest.mark.parametrize("count", [3, 4, 5, 6, 9, 17])
def test_exact_on_cubics(count):
    """With exact normals, whatever way the surface stands."""
    rng = np.random.default_rng(count)
    for size in (1e-3, 1, 1e3):
        turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        turn *= np.sign(np.linalg.det(turn))
        e, normals = points_on(CUBIC, count, rng)
        found = of_disk(size * e @ turn.T, turn[:, 2], normals @ turn.T)
        scaled = found._replace(
            K=found.K * size**2, H=found.H * size, k1=found.k1 * size, k2=found.k2 * size
        )
        assert_curvatures_of(scaled, CUBIC, turn)


def test_two_neighbours_determine_a_quadric_and_one_none():
    rng = np.random.default_rng(0)
    flat = CUBIC * (1, 1, 1, 0, 0, 0, 0)
    e, normals = points_on(flat, 5, rng)
    assert_curvatures_of(of_disk(e[:2], (0.0, 0.0, 1.0), normals[:2]), flat, np.eye(3))
    assert np.isnan(of_disk(e[:1], (0.0, 0.0, 1.0), normals[:1]).K)
    line = np.array([e[0], -e[0] * (1, 1, -1), 2 * e[0] * (1, 1, 2)])
    slopes = normals[[0, 0, 0]] * [[1, 1, 1], [-1, -1, 1], [2, 2, 1]]
    assert np.isnan(of_disk(line, (0.0, 0.0, 1.0), slopes).K)


def test_neighbours_without_a_normal_or_with_one_that_is_turned_are_left_out():
    rng = np.random.default_rng(1)
    e, normals = points_on(CUBIC, 7, rng)
    normals[2], normals[5] = np.nan, -normals[5]
    assert_curvatures_of(of_disk(e, (0.0, 0.0, 1.0), normals), CUBIC, np.eye(3))
    assert np.isnan(of_disk(e, (np.nan,) * 3, normals).H)


def errors(side, kind, given):
    """Mean errors of K and H on the torus, with normals of triangles or exact ones."""
    mesh = curvlib.Mesh(*torus(side, kind))
    x, y, z = mesh.vertices.T
    around = np.hypot(x, y)
    if given == "area":
        found = curvlib.estimate(mesh, "goldfeather_interrante")
        K, H = found.K, found.H
    else:
        tube = np.column_stack((2 * x / around, 2 * y / around, 0 * z))
        normals, points = mesh.vertices - tube, mesh.vertices
        offsets, ends, _, _ = mesh.find_adjacency()
        rings = [ends[offsets[v] : offsets[v + 1]] for v in range(len(points))]
        disks = [
            of_disk(points[r] - points[v], normals[v], normals[r]) for v, r in enumerate(rings)
        ]
        K, H = np.transpose([d[:2] for d in disks])
    k2 = (around - 2) / around
    return np.array([np.abs(K - k2).mean(), np.abs(H - (1 + k2) / 2).mean()])


def test_order_on_tori():
    """Two with exact normals; with those of triangles two on a regular mesh, none on another."""
    coarse, fine = (errors(side, "irregular", "exact") for side in (24, 48))
    assert (np.log2(coarse / fine) > 1.8).all()
    coarse, fine = (errors(side, "regular", "area") for side in (48, 96))
    assert (np.log2(coarse / fine) > 1.9).all()
    coarse, fine = (errors(side, "irregular", "area") for side in (48, 96))
    assert (np.abs(np.log2(coarse / fine)) < 0.3).all()
