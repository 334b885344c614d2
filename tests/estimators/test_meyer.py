"""Estimator `meyer` against code for one vertex at a time, written from the paper; its order."""

import numpy as np
import pytest

import curvlib
from curvlib.meshes.torus import torus


def angle(a, b):
    return np.arccos(np.dot(a, b) / np.sqrt(np.dot(a, a) * np.dot(b, b)))


def centre(a, b):
    """Of the circle through the origin, a and b."""
    normal = np.cross(a, b)
    return np.linalg.solve([a, b, normal], [np.dot(a, a) / 2, np.dot(b, b) / 2, 0])


def cell(a, b):
    """The part of a triangle at the origin nearer to it than to a or b; of an obtuse triangle half
    or a quarter."""
    area = np.linalg.norm(np.cross(a, b)) / 2
    at = angle(a, b), angle(-a, b - a), angle(-b, a - b)
    if max(at) > np.pi / 2:
        return area / (2 if at[0] > np.pi / 2 else 4)
    c = centre(a, b)
    return (np.linalg.norm(np.cross(a / 2, c)) + np.linalg.norm(np.cross(c, b / 2))) / 2


def principal_frame(edges, N, H, areas):
    """d1 and d2 of the form with trace 2 H fitted to the normal curvatures of the edges."""
    X = np.cross(N, [0.36, 0.48, 0.8])
    X /= np.linalg.norm(X)
    Y = np.cross(N, X)
    rows, right = [], []
    for e, a in zip(edges, areas):
        t = np.array([np.dot(e, X), np.dot(e, Y)])
        x, y = t / np.linalg.norm(t)
        # B = [[u, v], [v, 2 H - u]]
        rows.append(np.sqrt(a) * np.array([x * x - y * y, 2 * x * y]))
        right.append(np.sqrt(a) * (-2 * np.dot(e, N) / np.dot(e, e) - 2 * H * y * y))
    u, v = np.linalg.lstsq(rows, right, rcond=None)[0]
    _, axes = np.linalg.eigh([[u, v], [v, 2 * H - u]])
    return [axes[0, j] * X + axes[1, j] * Y for j in (1, 0)]


def of_vertex(v, ring):
    """The six curvatures of a closed one-ring (n, 3) around v, and the area of its cell."""
    edges = np.asarray(ring) - v
    pairs = list(zip(edges, np.roll(edges, -1, axis=0)))
    areas = [np.linalg.norm(np.cross(a, b)) / 2 for a, b in pairs]
    cells = sum(cell(a, b) for a, b in pairs)
    K = (2 * np.pi - sum(angle(a, b) for a, b in pairs)) / cells
    towards = np.zeros(3)
    for a, b in pairs:
        # The angle at a is opposite the edge b, and the one at b opposite a.
        towards += b / np.tan(angle(-a, b - a)) + a / np.tan(angle(-b, a - b))
    N = sum(np.cross(a, b) for a, b in pairs)
    N = N / np.linalg.norm(N)
    H = np.linalg.norm(towards) / (4 * cells) * -np.sign(np.dot(towards, N))
    gap = np.sqrt(max(H * H - K, 0))
    at_edges = [areas[i - 1] + areas[i] for i in range(len(areas))]
    return K, H, H + gap, H - gap, *principal_frame(edges, N, H, at_edges), cells


@pytest.mark.parametrize("seed", range(3))
def test_against_the_formulas_for_one_vertex(seed):
    """On an irregular mesh with noise: obtuse triangles, saddles, vertices where H^2 < K."""
    vertices, faces = torus(14, "irregular", seed)
    vertices = vertices * (1, 0.7, 1.3) + 0.02 * np.random.default_rng(seed).normal(size=(196, 3))
    mesh = curvlib.Mesh(vertices, faces)
    found, clamped, total = curvlib.estimate(mesh, "meyer"), 0, 0.0
    for centres, neighbours in mesh.rings:
        for v, ring in zip(centres, neighbours.T):
            K, H, k1, k2, d1, d2, area = of_vertex(vertices[v], vertices[ring])
            assert found.K[v] == pytest.approx(K, rel=1e-9, abs=1e-9)
            assert found.H[v] == pytest.approx(H, rel=1e-9)
            assert found.k1[v] == pytest.approx(k1, rel=1e-6)
            assert found.k2[v] == pytest.approx(k2, rel=1e-6, abs=1e-9)
            total += found.K[v] * area
            if k1 == k2:
                clamped += 1
                np.testing.assert_allclose([found.k1[v], found.k2[v]], found.H[v], rtol=1e-15)
                assert np.isnan([found.d1[v], found.d2[v]]).all()
            else:
                assert abs(np.dot(found.d1[v], d1)) == pytest.approx(1, abs=1e-9)
                assert abs(np.dot(found.d2[v], d2)) == pytest.approx(1, abs=1e-9)
                assert found.k1[v] * found.k2[v] == pytest.approx(found.K[v], rel=1e-12)
    assert 0 < clamped < 60
    assert (found.H < 0).any()
    assert total == pytest.approx(0, abs=1e-9)


def test_directions_are_a_right_handed_frame():
    mesh = curvlib.tessellate(curvlib.surface("ellipsoid"), 16, "random", seed=2)
    found = curvlib.estimate(mesh, "meyer")
    there = np.isfinite(found.d1).all(1)
    assert there.mean() > 0.5
    d1, d2, N = found.d1[there], found.d2[there], mesh.normals[there]
    np.testing.assert_allclose((d1 * d1).sum(1), 1, rtol=1e-12)
    np.testing.assert_allclose((d1 * d2).sum(1), 0, atol=1e-12)
    assert ((np.cross(d1, d2) * N).sum(1) > 0.8).all()


def test_edges_along_two_lines_determine_no_axis():
    """Kn along x and y is that of x^2 - y^2 turned by any angle for which they agree."""
    rim = np.array([[1, 0, -0.2], [0, 1, 0.1], [-1, 0, -0.2], [0, -1, 0.1]])
    faces = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    found = curvlib.estimate((np.vstack((rim, [[0, 0, 0]])), faces), "meyer")
    assert found.H[4] > 0
    assert found.k1[4] > found.k2[4]
    assert np.isnan([found.d1[4], found.d2[4]]).all()
    skew = rim @ np.array([[1, 0.5, 0], [0, 1, 0], [0, 0, 1]])
    found = curvlib.estimate((np.vstack((skew, [[0, 0, 0]])), faces), "meyer")
    assert np.isfinite([found.d1[4], found.d2[4]]).all()


def test_order_on_tori():
    """Two on a regular mesh, of all quantities; none on an irregular one."""
    errors = {}
    for kind in ("regular", "irregular"):
        for side in (48, 96):
            vertices, faces = torus(side, kind)
            found = curvlib.estimate((vertices, faces), "meyer")
            x, y, _ = vertices.T
            around = np.hypot(x, y)
            k2 = (around - 2) / around
            d1 = np.abs((found.d1[:, 1] * x - found.d1[:, 0] * y) / around)
            errors[kind, side] = [
                np.abs(found.K - k2).mean(),
                np.abs(found.H - (1 + k2) / 2).mean(),
                np.abs(found.k1 - 1).mean(),
                np.abs(found.k2 - k2).mean(),
                np.nanmean(np.arcsin(np.minimum(d1, 1))),
            ]
    slopes = {
        kind: np.log2(np.divide(errors[kind, 48], errors[kind, 96]))
        for kind in ("regular", "irregular")
    }
    assert (slopes["regular"] > 1.9).all()
    assert (np.abs(slopes["irregular"]) < 0.2).all()
