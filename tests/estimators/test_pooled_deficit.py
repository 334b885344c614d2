"""Estimator `pooled_deficit`: sums over some rings, at boundaries, of closed meshes."""

import numpy as np
import pytest
import pyvista

import curvlib
from curvlib.meshes.torus import torus


def integrals(vertices, faces):
    """Per vertex the integrals of K and H over its cell, the area of that, by faces and edges."""
    deficits = np.full(len(vertices), 2 * np.pi)
    edges, areas = np.zeros(len(vertices)), np.zeros(len(vertices))
    normals, sides = [], {}
    for number, face in enumerate(faces):
        for v, a, b in zip(face, np.roll(face, -1), np.roll(face, -2)):
            p, q = vertices[a] - vertices[v], vertices[b] - vertices[v]
            deficits[v] -= np.arctan2(np.linalg.norm(np.cross(p, q)), np.dot(p, q))
            areas[v] += np.linalg.norm(np.cross(p, q)) / 6
            sides[v, a] = number
        normals.append(np.cross(p, q) / np.linalg.norm(np.cross(p, q)))
    for (v, a), number in sides.items():
        if v < a and (a, v) in sides:
            left, right = normals[number], normals[sides[a, v]]
            along = vertices[a] - vertices[v]
            length = np.linalg.norm(along)
            sine = np.dot(np.cross(right, left), along) / length
            angle = -np.arctan2(sine, np.dot(left, right))
            edges[[v, a]] += length * angle / 4
    return deficits, edges, areas


def pooled(mesh, near):
    """K and H by sums over the pairs of vertices in `near` (V, V)."""
    deficits, edges, areas = np.where(mesh.closed, integrals(mesh.vertices, mesh.faces), 0)
    with np.errstate(invalid="ignore"):
        return near @ deficits / (near @ areas), near @ edges / (near @ areas)


def adjacency(mesh):
    """(V, V): whether two vertices are equal or joined by an edge."""
    adjacent = np.eye(len(mesh.vertices), dtype=int)
    for k in range(3):
        adjacent[mesh.faces[:, k], mesh.faces[:, k - 1]] = 1
    return adjacent | adjacent.T


@pytest.mark.parametrize("rings", [1, 2, 3])
def test_against_sums_over_pairs(rings):
    """On an open mesh, at its boundary too, and on a torus with saddles."""
    surface = curvlib.tessellate(curvlib.surface("revolution"), 12, "random", seed=3)
    for mesh in (surface, curvlib.Mesh(*torus(14, "irregular"))):
        found = curvlib.estimate(mesh, "pooled_deficit", rings=rings)
        near = np.linalg.matrix_power(adjacency(mesh), rings) > 0
        K, H = pooled(mesh, near.astype(int))
        np.testing.assert_allclose(found.K, K, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(found.H, H, rtol=1e-9)
        assert np.isfinite(found.K).all()


def test_against_sums_over_a_ball():
    """Over the vertices within the radius that paths inside the ball join to its centre."""
    mesh = curvlib.Mesh(*torus(14, "irregular"))
    apart = np.linalg.norm(mesh.vertices[:, None] - mesh.vertices, axis=2)
    adjacent = adjacency(mesh)
    near = [
        np.linalg.matrix_power(adjacent * ball, 10)[v] > 0 for v, ball in enumerate(apart <= 1.2)
    ]
    assert (near != (apart <= 1.2)).any()
    K, H = pooled(mesh, np.array(near, dtype=int))
    found = curvlib.estimate(mesh, "pooled_deficit", radius=1.2)
    np.testing.assert_allclose(found.K, K, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(found.H, H, rtol=1e-9)


def test_the_deficits_of_a_closed_mesh_sum_up_to_two_pi_times_its_euler_characteristic():
    """Over the whole mesh: of an ellipsoid and of a torus."""
    ball = pyvista.Icosphere(radius=1, nsub=2)
    sphere = curvlib.Mesh(ball.points * (1, 2, 3.0), ball.regular_faces)
    ring = curvlib.Mesh(*torus(12, "irregular"))
    for mesh, euler in ((sphere, 2), (ring, 0)):
        a, b, c = mesh.vertices[mesh.faces].swapaxes(0, 1)
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
        K = curvlib.estimate(mesh, "pooled_deficit", radius=100).K
        np.testing.assert_allclose(K * area, 2 * np.pi * euler, atol=1e-9)


def test_vertices_without_a_closed_ring_have_the_cells_beside_them():
    """The rim of a pyramid that of its apex; a lone triangle none."""
    angle = 2 * np.pi * np.arange(5) / 5
    rim = np.column_stack((np.cos(angle), np.sin(angle), 0 * angle))
    k = np.arange(5)
    faces = np.column_stack((k, (k + 1) % 5, np.full(5, 5)))
    mesh = curvlib.Mesh(np.vstack((rim, [[0, 0, 0.4]])), faces)
    with pytest.warns(curvlib.MeshWarning):
        apex = curvlib.estimate(mesh, "gauss_bonnet")
    found = curvlib.estimate(mesh, "pooled_deficit")
    np.testing.assert_allclose(found.K, apex.K[5], rtol=1e-15)
    np.testing.assert_allclose(found.H, apex.H[5], rtol=1e-15)
    lone = curvlib.estimate((rim[:3], faces[:1] % 3), "pooled_deficit")
    assert np.isnan(lone.K).all()
    assert np.isnan(lone.H).all()


def test_folded_edges_are_left_out_of_H_alone():
    """A flat bag: each half around a vertex of its own, the rim folded by pi."""
    angle = 2 * np.pi * np.arange(6) / 6
    rim = np.column_stack((np.cos(angle), np.sin(angle), 0 * angle))
    k = np.arange(6)
    top = np.column_stack((k, (k + 1) % 6, np.full(6, 6)))
    bottom = np.column_stack(((k + 1) % 6, k, np.full(6, 7)))
    vertices = np.vstack((rim, [[0.1, 0, 0], [-0.1, 0, 0]]))
    found = curvlib.estimate((vertices, np.vstack((top, bottom))), "pooled_deficit")
    np.testing.assert_allclose(found.H, 0, atol=1e-15)
    # Without the other middle the rim has 4 pi of deficit, a third of one side's area less.
    area = 3 * np.sqrt(3) / 2
    np.testing.assert_allclose(found.K[6:], 4 * np.pi / (2 * area - area / 3))


def test_rings_against_marching_cubes():
    """Slivers of marching cubes: the error over one cell is divided by 4, 8 and 12 at least over
    one, two and three rings."""
    grid = pyvista.ImageData(dimensions=(30,) * 3, origin=(-14.5,) * 3)
    grid["level"] = 12 - np.linalg.norm(grid.points - (0.3, 0.2, -0.1), axis=1)
    found = grid.contour([0.0], scalars="level").triangulate()
    mesh = curvlib.Mesh(found.points.astype(float), found.regular_faces[:, ::-1])
    assert mesh.closed.all()

    def off(name, **options):
        estimates = curvlib.estimate(mesh, name, **options)
        scaled = np.array([estimates.K * 144, np.abs(estimates.H) * 12])
        return np.abs(scaled - 1).mean(1)

    one = off("gauss_bonnet")
    assert (one > 0.15).all()
    for rings, factor in ((1, 4), (2, 8), (3, 12)):
        assert (off("pooled_deficit", rings=rings) < one / factor).all()


def errors(side, kind, **options):
    vertices, faces = torus(side, kind)
    around = np.hypot(*vertices[:, :2].T)
    found = curvlib.estimate((vertices, faces), "pooled_deficit", **options)
    k2 = (around - 2) / around
    return np.array([np.abs(found.K - k2).mean(), np.abs(found.H - (1 + k2) / 2).mean()])


def test_order_on_tori():
    """Two on a regular mesh over rings; in a ball whose radius is the root of the edge, one in the
    edge on an irregular mesh, as the squared radius; none there over a ring."""
    for rings in (1, 2, 3):
        slopes = np.log2(errors(48, "regular", rings=rings) / errors(96, "regular", rings=rings))
        assert (slopes > 1.9).all()
    balls = errors(24, "irregular", radius=0.8) / errors(96, "irregular", radius=0.4)
    assert (np.log2(balls) / 2 > 0.9).all()
    stagnant = errors(96, "irregular") / errors(192, "irregular")
    assert (np.log2(stagnant) < 0.3).all()
