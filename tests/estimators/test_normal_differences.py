"""Estimators `rusinkiewicz` and `theisel`: against NumPy for one vertex, exact fields, orders."""

import numpy as np
import pytest

import curvlib
from curvlib.catalogue import estimators
from curvlib.kit.ball import Ball
from curvlib.kit.disk import SPACE
from curvlib.meshes.jittered import graph, jittered
from curvlib.meshes.torus import torus

NAMES = ["rusinkiewicz", "theisel"]
of_rusinkiewicz, of_theisel = (estimators.module(name).estimate for name in NAMES)


def normals(disk):
    return disk.exact_normal


def rusinkiewicz(ball, normals):
    return of_rusinkiewicz(ball, normals)


def theisel(ball, normals):
    return of_theisel(ball, normals)


EXACT = {"rusinkiewicz": rusinkiewicz, "theisel": theisel}


def turn(a, b):
    """The rotation about a x b that takes the unit vector a to b, by Rodrigues' formula."""
    axis = np.cross(a, b)
    K = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    return np.eye(3) + K + K @ K / (1 + a @ b)


def cell(a, b, c):
    """The area of the part of a triangle in the mixed cell of its corner a."""
    area = np.linalg.norm(np.cross(b - a, c - a)) / 2
    at = [(q - p) @ (r - p) for p, q, r in ((a, b, c), (b, c, a), (c, a, b))]
    if min(at) < 0:
        return area / 2 if at[0] < 0 else area / 4
    # From the corner to the midpoints of its edges and to the centre of the circumscribed circle.
    u, v = b - a, c - a
    n = np.cross(u, v)
    centre = ((u @ u) * np.cross(v, n) + (v @ v) * np.cross(n, u)) / (2 * n @ n)
    return sum(np.linalg.norm(np.cross(e / 2, centre)) / 2 for e in (u, v))


def tensor_of_rusinkiewicz(vertices, faces, N, v):
    """The mean (3, 3) of the triangles' tensors at a vertex."""
    total, weight = np.zeros((3, 3)), 0.0
    for f in faces[(faces == v).any(1)]:
        a, b, c = np.roll(f, -np.flatnonzero(f == v)[0])
        p = vertices[[a, b, c]]
        facet = np.cross(p[1] - p[0], p[2] - p[0])
        facet /= np.linalg.norm(facet)
        U = (p[1] - p[0]) / np.linalg.norm(p[1] - p[0])
        frame = np.array([U, np.cross(facet, U)])
        rows, right = [], []
        for i, j in ((a, b), (b, c), (c, a)):
            u, w = frame @ (vertices[j] - vertices[i])
            rows += [[u, w, 0], [0, u, w]]
            right += list(frame @ (N[j] - N[i]))
        p_, q_, r_ = np.linalg.lstsq(rows, right, rcond=None)[0]
        turned = frame @ turn(facet, N[v]).T
        share = cell(*p)
        total += share * turned.T @ [[p_, q_], [q_, r_]] @ turned
        weight += share
    return total / weight


def tensor_of_theisel(vertices, faces, N, v):
    P = np.eye(3) - np.outer(N[v], N[v])
    total, weight = np.zeros((3, 3)), 0.0
    for f in faces[(faces == v).any(1)]:
        _, b, c = np.roll(f, -np.flatnonzero(f == v)[0])
        edges = P @ (vertices[[b, c]] - vertices[v]).T
        S = P @ (N[[b, c]] - N[v]).T @ np.linalg.pinv(edges)
        share = np.cross(*edges.T) @ N[v]
        total, weight = total + share * S, weight + share
    return (total + total.T) / (2 * weight)


TENSORS = {"rusinkiewicz": tensor_of_rusinkiewicz, "theisel": tensor_of_theisel}


def facet_normals(mesh):
    """Unit normals of vertices, weighted by area."""
    a, b, c = mesh.vertices[mesh.faces].transpose(1, 0, 2)
    total = np.zeros_like(mesh.vertices)
    for k in range(3):
        np.add.at(total, mesh.faces[:, k], np.cross(b - a, c - a))
    return total / np.linalg.norm(total, axis=1)[:, None]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("surface", ["torus", "patch"])
def test_against_numpy_for_one_vertex(name, surface):
    """Boundary vertices among them."""
    mesh = jittered(surface, 17, seed=2)
    N = facet_normals(mesh)
    found = curvlib.estimate(mesh, name)
    for v in range(len(mesh.vertices)):
        S = TENSORS[name](mesh.vertices, mesh.faces, N, v)
        values, axes = np.linalg.eigh(S)
        flat = np.abs(axes.T @ N[v]).argmax()
        k2, k1 = np.delete(values, flat)
        assert found.k1[v] == pytest.approx(k1, abs=1e-10)
        assert found.k2[v] == pytest.approx(k2, abs=1e-10)
        assert found.K[v] == pytest.approx(k1 * k2, abs=1e-10)
        assert found.H[v] == pytest.approx((k1 + k2) / 2, abs=1e-10)
        if k1 - k2 > 1e-3:
            axis = np.delete(axes, flat, axis=1)[:, 1]
            assert abs(found.d1[v] @ axis) == pytest.approx(1, abs=1e-8)


def ball_of(points, triangles):
    """A Ball of points (p, 3) of which the first is the vertex."""
    up = 0.0, 0.0, 1.0
    triangles = np.ascontiguousarray(np.transpose(triangles), np.int32)
    across = np.full_like(triangles, -1)
    inside, space = np.ones(triangles.shape[1]), np.zeros(SPACE)
    points = np.ascontiguousarray(points.T)
    return Ball(points, triangles, across, inside, up, up, 0.0, True, np.inf, space)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("closed", [True, False])
def test_exact_on_linear_fields(name, closed):
    """N = (S x, 1) over a plane: the tensor of every triangle is S, and so is the mean."""
    rng = np.random.default_rng(3)
    angle = np.sort(rng.uniform(0, 2 * np.pi, 7))
    r = rng.uniform(0.5, 1.5, 7)
    points = np.vstack((np.zeros(3), np.stack((r * np.cos(angle), r * np.sin(angle), 0 * r), -1)))
    triangles = [(0, 1 + k, 1 + (k + 1) % 7) for k in range(7 if closed else 4)]
    S = np.array([[0.7, 0.4], [0.4, -0.3]])
    field = np.vstack(((S @ points[:, :2].T), np.ones(8)))
    found = EXACT[name](ball_of(points, triangles), np.ascontiguousarray(field))
    k2, k1 = np.linalg.eigvalsh(S)
    np.testing.assert_allclose((found.k1, found.k2), (k1, k2), atol=1e-13)
    assert found.K == pytest.approx(np.linalg.det(S), abs=1e-13)


@pytest.mark.parametrize("name", NAMES)
def test_exact_normals_of_a_sphere(name):
    """N = x / R, so that the tensor of each triangle is that of the sphere."""
    points, faces, N = sphere()
    mesh = curvlib.Mesh(points, faces, normals=N)
    found = curvlib.estimate(mesh, EXACT[name])
    np.testing.assert_allclose(found.H, 0.5, atol=1e-12)
    np.testing.assert_allclose(found.K, 0.25, atol=1e-12)


def sphere():
    """A sphere of radius 2, irregular."""
    mesh = jittered("ellipsoid", 15, seed=4)
    points = mesh.vertices / [1.0, 0.8, 0.6]
    points /= np.linalg.norm(points, axis=1)[:, None]
    return 2 * points, mesh.faces, points


@pytest.mark.parametrize("name", NAMES)
def test_exact_normals_of_a_quadric(name):
    """At the apex of z = x^2 - x y - y^2 / 2 the only error is that of unit length: O(h^2) even on
    irregular meshes."""
    errors = []
    for size in (0.2, 0.1, 0.05):
        mesh = graph(9, lambda x, y: 0 * x, seed=5)
        x, y = size * mesh.vertices[:, :2].T
        x, y = x - x[40], y - y[40]
        vertices = np.stack((x, y, x * x - x * y - y * y / 2), -1)
        N = np.stack((y - 2 * x, x + y, np.ones_like(x)), -1)
        N /= np.linalg.norm(N, axis=1)[:, None]
        found = curvlib.estimate(curvlib.Mesh(vertices, mesh.faces, normals=N), EXACT[name])
        # Of f = x^2 - x y - y^2 / 2 at its critical point: K = -2 - 1, H = -(2 - 1) / 2.
        errors.append([abs(found.K[40] + 3), abs(found.H[40] + 0.5)])
    errors = np.array(errors)
    assert errors[0].max() < 0.2
    assert (np.log2(errors[:-1] / errors[1:]) > 1.8).all()


def slopes(name_or_function, meshes, part):
    errors = []
    for mesh in meshes:
        found = curvlib.estimate(mesh, name_or_function)
        assert np.isfinite(found.K).all()
        inner = part(mesh)
        errors.append(
            [np.abs(found.K - mesh.K)[inner].mean(), np.abs(found.H - mesh.H)[inner].mean()]
        )
    return np.log2(np.divide(*errors))


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("surface", ["torus", "ellipsoid", "patch"])
def test_order_with_exact_normals(name, surface):
    """At the boundary, too."""
    meshes = [jittered(surface, n, seed=6) for n in (40, 80)]
    assert (slopes(EXACT[name], meshes, lambda m: ~m.boundary) > 0.9).all()
    if surface == "patch":
        assert (slopes(EXACT[name], meshes, lambda m: m.boundary) > 0.8).all()


@pytest.mark.parametrize("name", NAMES)
def test_order_with_normals_of_triangles(name):
    """O(h^2) on a grid; none on irregular meshes."""
    grids = []
    for side in (48, 96):
        vertices, faces = torus(side, "regular")
        around = np.hypot(vertices[:, 0], vertices[:, 1])
        K = (around - 2) / around
        grids.append(curvlib.Mesh(vertices, faces, K=K, H=(1 + K) / 2))
    assert (slopes(name, grids, lambda m: ~m.boundary) > 1.9).all()
    irregular = [jittered("torus", n, seed=7) for n in (40, 80)]
    assert (slopes(name, irregular, lambda m: ~m.boundary) < 0.6).all()
