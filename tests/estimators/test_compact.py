"""The compact scheme: orders, errors beside fits of heights alone, meshes of all kinds."""

import numpy as np
import pytest
from test_fits import exact, graph, wavy
from test_jets import errors

import curvlib
from curvlib.meshes.torus import torus


def round_torus(side, seed=4):
    vertices, faces = torus(side, "irregular", seed)
    around = np.hypot(vertices[:, 0], vertices[:, 1])
    k2 = (around - 2) / around
    return (vertices, faces), k2, (1 + k2) / 2


@pytest.mark.parametrize(("degree", "order", "ratio"), [(6, 4.8, 80), (5, 3.8, 15), (4, 2.9, 9)])
def test_order_and_error_on_an_irregular_torus(degree, order, ratio):
    found = []
    for side in (64, 96):
        mesh, K, H = round_torus(side)
        every = np.ones(len(K), bool)
        fine = curvlib.estimate(mesh, "compact_hermite", degree=degree)
        found.append(errors(fine, K, H, every))
    plain = curvlib.estimate(mesh, "jet", degree=4, rings=3, fit="approximation")
    assert (np.log(found[0] / found[1]) / np.log(1.5) > order).all()
    assert (ratio * found[1] < errors(plain, K, H, every)).all()


@pytest.mark.parametrize(("degree", "order"), [(6, 4.6), (5, 3.8), (4, 2.8)])
def test_order_on_an_open_graph(degree, order):
    found = []
    for n in (41, 61):
        mesh = graph(n, wavy, seed=4)
        x, y, _ = mesh.vertices.T
        K, H = exact(x, y, wavy)
        fine = curvlib.estimate(mesh, "compact_hermite", degree=degree)
        assert np.isfinite(fine.K).all()
        found.append(errors(fine, K, H, ~mesh.boundary))
    assert (np.log(found[0] / found[1]) / np.log(1.5) > order).all()


def test_principal_directions():
    """Of a torus: 0.01 degrees in the mean."""
    (vertices, faces), _, _ = round_torus(64)
    found = curvlib.estimate((vertices, faces), "compact_hermite")
    x, y, _ = vertices.T
    d2 = np.column_stack((-y, x, 0 * x)) / np.hypot(x, y)[:, None]
    sine = np.linalg.norm(np.cross(found.d2, d2), axis=1)
    assert np.degrees(np.arcsin(np.minimum(sine, 1))).mean() < 0.01
    np.testing.assert_allclose((found.d1 * found.d2).sum(1), 0, atol=1e-12)


def split_twice(mesh):
    """Triangles split twice at their centres: valences 3 and about 24."""
    points, faces = mesh.vertices, mesh.faces
    for _ in range(2):
        new = len(points) + np.arange(len(faces))
        points = np.vstack((points, points[faces].mean(1)))
        a, b, c = faces.T
        faces = np.vstack([np.column_stack(t) for t in ((a, b, new), (b, c, new), (c, a, new))])
    return points, faces


def stretched(n):
    """A graph over a jittered grid of 1 : 10."""
    mesh = graph(n, lambda x, y: 0 * x, seed=6)
    x, y = mesh.vertices[:, 0], 10 * mesh.vertices[:, 1]
    return (np.column_stack((x, y, f(x, y))), mesh.faces), x, y, ~mesh.boundary


def f(x, y):
    return 0.3 * x * x - 0.02 * y * y + 0.1 * np.sin(2 * x) * np.cos(0.2 * y)


@pytest.mark.parametrize("degree", [6, 5, 4])
def test_valences_from_3_on_and_long_triangles(degree):
    points, faces = split_twice(graph(17, lambda x, y: 0 * x, seed=5))
    x, y = points[:, 0], points[:, 1]
    inner = (np.abs(x) < 1) & (np.abs(y) < 1)
    surface = np.column_stack((x, y, wavy(x, y))), faces
    cases = [(surface, *exact(x, y, wavy), inner)]
    mesh, x, y, inner = stretched(33)
    cases.append((mesh, *exact(x, y, f), inner))
    for mesh, K, H, inner in cases:
        found = curvlib.estimate(mesh, "compact_hermite", degree=degree)
        plain = curvlib.estimate(mesh, "jet", degree=4, rings=3, fit="approximation")
        assert np.isfinite(found.K).all()
        assert (errors(found, K, H, inner) < errors(plain, K, H, inner)).all()


@pytest.mark.parametrize("degree", [6, 5, 4])
@pytest.mark.parametrize("noise", [0.05, 0.3])
def test_noise_does_not_make_it_diverge(degree, noise):
    """In units of the edge; beside the jet of degree 6, in the median and in the worst vertex."""
    (vertices, faces), _, _ = round_torus(32)
    edge = np.linalg.norm(vertices[faces[:, 0]] - vertices[faces[:, 1]], axis=1).mean()
    rng = np.random.default_rng(7)
    rough = vertices + noise * edge * rng.normal(size=vertices.shape), faces
    H = np.abs(curvlib.estimate(rough, "compact_hermite", degree=degree).H)
    reference = np.abs(curvlib.estimate(rough, "jet", degree=6, rings=3).H)
    assert np.isfinite(H).all()
    assert np.median(H) < 3 * np.median(reference)
    assert H.max() < 10 * reference.max()


def test_a_plane_is_flat():
    mesh = graph(12, lambda x, y: 0.3 * x - 0.2 * y)
    for degree in (6, 5, 4):
        found = curvlib.estimate(mesh, "compact_hermite", degree=degree)
        assert np.abs(found.H).max() < 1e-10


@pytest.mark.parametrize("degree", [6, 4])
def test_any_number_of_threads_gives_the_same_bytes(monkeypatch, degree):
    mesh = curvlib.tessellate(curvlib.surface("revolution"), 16, "random", seed=7)
    alone = curvlib.estimate(mesh, "compact_hermite", degree=degree)
    monkeypatch.setattr("curvlib.meshes.loops.BLOCK", 7)
    for threads in (1, 2, 5):
        again = curvlib.estimate(mesh, "compact_hermite", threads=threads, degree=degree)
        for quantity in ("K", "H", "k1", "d1"):
            np.testing.assert_array_equal(getattr(again, quantity), getattr(alone, quantity))


def test_float32_far_from_the_origin():
    (vertices, faces), _, _ = round_torus(24)
    rounded = (vertices + 1e6 / 2**10).astype(np.float32)
    single = curvlib.estimate((rounded, faces), "compact_hermite")
    double = curvlib.estimate((rounded.astype(float), faces), "compact_hermite")
    np.testing.assert_array_equal(single.K, double.K)
    far = curvlib.estimate((vertices + 1e6, faces), "compact_hermite")
    near = curvlib.estimate((vertices, faces), "compact_hermite")
    np.testing.assert_allclose(far.K, near.K, atol=1e-5)
