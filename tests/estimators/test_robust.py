"""Estimator `robust`: displaced vertices on closed forms, what it costs without them, its order."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

import curvlib
from curvlib.meshes.jittered import graph, jittered
from curvlib.meshes.torus import torus


def of_torus(side, seed):
    mesh = jittered("torus", side, seed)
    return mesh.vertices, mesh.faces, mesh.k1, mesh.k2


def of_ellipsoid(count, seed, axes=(1, 0.8, 0.6)):
    """Random points of the sphere, stretched; K and H by the support function."""
    rng = np.random.default_rng(seed)
    i = np.arange(count) + 0.5
    z, turn = 1 - 2 * i / count, np.pi * (1 + 5**0.5) * i
    r = np.sqrt(1 - z * z)
    points = np.stack((r * np.cos(turn), r * np.sin(turn), z), -1)
    points += 0.7 / np.sqrt(count) * rng.normal(size=points.shape)
    points /= np.linalg.norm(points, axis=1)[:, None]
    faces = ConvexHull(points).simplices.astype(np.int64)
    a, b, c = points[faces].transpose(1, 0, 2)
    inward = (np.cross(b - a, c - a) * a).sum(1) < 0
    faces[inward] = faces[inward, ::-1]
    axes = np.array(axes, float)
    vertices = points * axes
    g = (vertices**2 / axes**4).sum(1)
    K = 1 / (axes.prod() ** 2 * g * g)
    H = ((axes**2).sum() - (vertices**2).sum(1)) / (2 * axes.prod() ** 2 * g**1.5)
    gap = np.sqrt(np.maximum(H * H - K, 0))
    return vertices, faces, H + gap, H - gap


def displaced(vertices, faces, part, seed, direction=None):
    """The vertices with a part of them moved by one to four mean edges; which."""
    rng = np.random.default_rng(seed)
    edge = curvlib.Mesh(vertices, faces).mean_edge
    moved = rng.permutation(len(vertices)) < part * len(vertices)
    way = rng.normal(size=vertices.shape) if direction is None else direction
    way = way / np.linalg.norm(way, axis=1)[:, None]
    step = moved * rng.uniform(1, 4, len(vertices)) * edge
    return vertices + step[:, None] * way, moved


FORMS = {
    "torus": lambda: of_torus(64, 21),
    "sphere": lambda: of_ellipsoid(1200, 22, (1, 1, 1)),
    "ellipsoid": lambda: of_ellipsoid(1000, 23),
}


def off(found, k1, k2):
    """The larger error of k1 and k2 at each vertex."""
    return np.maximum(np.abs(found.k1 - k1), np.abs(found.k2 - k2))


@pytest.mark.parametrize("form", FORMS)
def test_a_tenth_of_the_vertices_displaced(form):
    """Values elsewhere as of the clean mesh, where a least-squares fit is lost; those of the
    displaced vertices are of the surface beside them."""
    vertices, faces, k1, k2 = FORMS[form]()
    clean = off(curvlib.estimate((vertices, faces), "robust"), k1, k2)
    spoiled, moved = displaced(vertices, faces, 0.1, 5)
    errors = off(curvlib.estimate((spoiled, faces), "robust"), k1, k2)
    rest = errors[~moved]
    assert np.isnan(rest).mean() < 0.005
    assert np.nanmedian(rest) < 1.25 * np.median(clean)
    assert np.nanmean(rest) < 1.5 * clean.mean()
    assert (rest > 0.5).mean() < 0.015
    assert np.nanmedian(errors[moved]) < 0.3
    plain = off(curvlib.estimate((spoiled, faces), "jet"), k1, k2)[~moved]
    assert (plain > 0.5).mean() > 0.5


@pytest.mark.parametrize(("part", "lost"), [(0.05, 0.004), (0.2, 0.06), (0.3, 0.18)])
@pytest.mark.parametrize("form", FORMS)
def test_breakdown(form, part, lost):
    """Edges of the torus are up to four times as long one way as the other: the hardest."""
    vertices, faces, k1, k2 = FORMS[form]()
    spoiled, moved = displaced(vertices, faces, part, 6)
    errors = off(curvlib.estimate((spoiled, faces), "robust"), k1, k2)[~moved]
    assert (errors > 0.5).mean() <= lost
    wider = off(curvlib.estimate((spoiled, faces), "robust", rings=3), k1, k2)[~moved]
    assert (wider > 0.5).mean() <= lost


@pytest.mark.parametrize("sign", [1, -1])
def test_spikes_along_one_normal(sign):
    """All to one side, as errors of a scanner: no bias of H."""
    vertices, faces, _, _ = of_ellipsoid(1500, 24, (1, 1, 1))
    spoiled, moved = displaced(vertices, faces, 0.1, 7, sign * vertices)
    H = curvlib.estimate((spoiled, faces), "robust").H[~moved]
    assert abs(np.nanmedian(H) - 1) < 0.03
    assert np.nanquantile(np.abs(H - 1), 0.98) < 0.1


def test_exact_on_a_plane_with_displaced_vertices():
    """Where the others are on a plane, K and H are 0 but for rounding."""
    mesh = graph(24, lambda x, y: 0.3 * x - 0.2 * y)
    vertices, moved = displaced(mesh.vertices, mesh.faces, 0.08, 8, np.tile((0, 0, 1.0), (576, 1)))
    found = curvlib.estimate((vertices, mesh.faces), "robust")
    inner = ~moved & ~mesh.boundary
    flat = np.abs(found.H[inner]) < 1e-9
    assert flat.mean() > 0.99
    assert np.abs(found.K[inner][flat]).max() < 1e-9


def test_as_a_jet_on_clean_meshes_and_under_gaussian_noise():
    for vertices, faces, k1, k2 in (of_torus(44, 25), of_ellipsoid(1000, 26)):
        rng = np.random.default_rng(9)
        edge = curvlib.Mesh(vertices, faces).mean_edge
        for noise in (0, 0.03):
            points = vertices + noise * edge * rng.normal(size=vertices.shape)
            ours = curvlib.estimate((points, faces), "robust")
            plain = curvlib.estimate((points, faces), "jet", fit="approximation")
            K, H = k1 * k2, (k1 + k2) / 2
            for a, b, exact in ((ours.K, plain.K, K), (ours.H, plain.H, H)):
                assert np.abs(a - exact).mean() < 1.12 * np.abs(b - exact).mean()


@pytest.mark.parametrize("rings", [2, 3])
def test_order_on_irregular_meshes(rings):
    """Of K and H in the mean over interior vertices, of the median at the boundary."""
    errors = []
    for n in (33, 65):
        mesh = jittered("patch", n)
        found = curvlib.estimate(mesh, "robust", rings=rings)
        assert np.isfinite(found.K).all()
        rest = [np.abs(found.K - mesh.K), np.abs(found.H - mesh.H)]
        errors.append(
            [
                f(e[part])
                for e in rest
                for f, part in ((np.mean, ~mesh.boundary), (np.median, mesh.boundary))
            ]
        )
    slopes = np.log2(np.divide(*errors))
    assert (slopes[::2] > 0.8).all()
    assert (slopes[1::2] > 0.5).all()


def test_same_bytes_on_any_number_of_threads():
    vertices, faces, _, _ = of_torus(70, 27)
    spoiled, _ = displaced(vertices, faces, 0.1, 10)
    one, two = (curvlib.estimate((spoiled, faces), "robust", threads=n) for n in (1, 2))
    for name in ("K", "H", "k1", "k2", "d1", "d2"):
        assert getattr(one, name).tobytes() == getattr(two, name).tobytes()


def test_no_surface():
    """Points anywhere in a cube: NaN at most vertices."""
    vertices, faces = torus(30, "regular")
    cloud = np.random.default_rng(11).uniform(-1, 1, vertices.shape)
    assert np.isnan(curvlib.estimate((cloud, faces), "robust").K).mean() > 0.5
