"""Estimator `ball_regression`: own code for one vertex at a time, spheres of voxels, order."""

import numpy as np
import pytest
import pyvista

import curvlib
from curvlib.meshes.jittered import jittered


def vector_areas(mesh):
    a, b, c = mesh.vertices[mesh.faces].swapaxes(0, 1)
    sums = np.zeros_like(mesh.vertices)
    for k in range(3):
        np.add.at(sums, mesh.faces[:, k], np.cross(b - a, c - a) / 6)
    return sums


def one(mesh, areas, u, v, radius):
    """The symmetric part of the slope of a weighted fit, by NumPy's least squares."""
    e = mesh.vertices - mesh.vertices[v]
    near = np.linalg.norm(e, axis=1) < radius
    near[v] = True
    X = np.cross(u[v], [0.6, 0.64, 0.48])
    frame = np.array([X / np.linalg.norm(X), np.cross(u[v], X / np.linalg.norm(X))])
    weight = (areas * u).sum(1) * (1 - (e**2).sum(1) / radius**2)
    root = np.sqrt(weight[near])[:, None]
    columns = np.column_stack((np.ones(near.sum()), e[near] @ frame.T))
    S = np.linalg.lstsq(root * columns, root * (u[near] @ frame.T), rcond=None)[0][1:]
    k, axes = np.linalg.eigh((S + S.T) / 2)
    return k[1], k[0], axes[:, 1] @ frame


@pytest.mark.parametrize("surface", ["torus", "patch"])
def test_against_least_squares_for_one_vertex(surface):
    mesh = jittered(surface, 20, 3)
    radius = 3 * mesh.mean_edge
    areas = vector_areas(mesh)
    distances = np.linalg.norm(mesh.vertices[:, None] - mesh.vertices, axis=2)
    weights = np.maximum(1 - (distances / (0.4 * radius)) ** 2, 0)
    u = weights @ areas
    u /= np.linalg.norm(u, axis=1)[:, None]
    found = curvlib.estimate(mesh, "ball_regression", radius="3 edges")
    for v in range(0, len(u), 7):
        k1, k2, d1 = one(mesh, areas, u, v, radius)
        assert found.k1[v] == pytest.approx(k1, abs=1e-10)
        assert found.k2[v] == pytest.approx(k2, abs=1e-10)
        assert abs(found.d1[v] @ d1) == pytest.approx(1, abs=1e-8)


def voxel_sphere(r):
    n = 2 * r + 5
    grid = pyvista.ImageData(dimensions=(n, n, n), origin=(-r - 2,) * 3)
    inside = ((grid.points**2).sum(1) <= r * r).astype(float)
    mesh = grid.contour([1.0], inside, method="marching_cubes")
    return curvlib.Mesh(mesh.points, mesh.regular_faces)


@pytest.mark.parametrize(
    ("r", "radius", "most"), [(10, 10, 0.03), (10, 14, 0.006), (30, 28, 0.009)]
)
def test_spheres_of_voxels(r, radius, most):
    """About the mean radius of the vertices, which lie inside the sphere: half a voxel and less."""
    mesh = voxel_sphere(r)
    mean = np.linalg.norm(mesh.vertices, axis=1).mean()
    found = curvlib.estimate(mesh, "ball_regression", radius=float(radius))
    for k in (found.k1, found.k2, found.H):
        assert np.abs(k * mean - 1).mean() < most


def test_noise():
    """White noise of 5 % of an edge on a torus: half the error of K and an eighth of that of H of a
    quadric over as many vertices."""
    mesh = jittered("torus", 50, 1)
    rng = np.random.default_rng(5)
    moved = mesh.vertices + rng.normal(0, 0.05 * mesh.mean_edge, mesh.vertices.shape)
    errors = []
    for name, options in (("ball_regression", {"radius": "3 edges"}), ("quadric", {"rings": 3})):
        found = curvlib.estimate((moved, mesh.faces), name, **options)
        errors.append([np.abs(found.K - mesh.K).mean(), np.abs(found.H - mesh.H).mean()])
    assert (np.divide(*errors) < (0.6, 0.15)).all()


def test_order_in_balls_that_shrink_slower_than_edges():
    """Radius in the square root of the edge: O(r^2) is O(h), on irregular meshes, where averaged
    normals of triangles, O(h) off each, have a mean that is less so."""
    errors = []
    for n in (32, 128):
        mesh = jittered("torus", n, 2)
        found = curvlib.estimate(
            mesh, "ball_regression", radius=4 * 32**0.5 * mesh.mean_edge / n**0.5
        )
        errors.append([np.abs(found.k1 - mesh.k1).mean(), np.abs(found.k2 - mesh.k2).mean()])
    assert (np.log(np.divide(*errors)) / np.log(4) > 0.8).all()


def test_radius_in_edges_has_no_order():
    """Averaged normals are O(h) off, over a ball of O(h)."""
    errors = []
    for n in (100, 200):
        mesh = jittered("ellipsoid", n)
        found = curvlib.estimate(mesh, "ball_regression", radius="3 edges")
        errors.append([np.abs(found.K - mesh.K).mean(), np.abs(found.H - mesh.H).mean()])
    assert (np.log2(np.divide(*errors)) < 0.5).all()
