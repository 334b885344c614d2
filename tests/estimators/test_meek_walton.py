"""Estimator `meek_walton`: spherical excess by angles, sums over closed meshes, order."""

import numpy as np

import curvlib
from curvlib.catalogue import estimators
from curvlib.meshes.torus import torus


def normals_of(mesh):
    a, b, c = mesh.vertices[mesh.faces].swapaxes(0, 1)
    facets = np.cross(b - a, c - a)
    sums = np.zeros_like(mesh.vertices)
    for k in range(3):
        np.add.at(sums, mesh.faces[:, k], facets)
    return sums / np.linalg.norm(sums, axis=1)[:, None], np.linalg.norm(facets, axis=1) / 2


def excess(a, b, c):
    """The area of a spherical triangle by its angles (Girard), with its sign."""
    angles = 0.0
    for p, q, r in ((a, b, c), (b, c, a), (c, a, b)):
        u, v = np.cross(p, q), np.cross(p, r)
        angles += np.arctan2(np.linalg.norm(np.cross(u, v)), u @ v)
    return np.sign(np.dot(a, np.cross(b, c))) * (angles - np.pi)


def by_angles(mesh, normals, areas):
    image, total = np.zeros(len(normals)), np.zeros(len(normals))
    for f, area in zip(mesh.faces, areas):
        image[f] += excess(*normals[f])
        total[f] += area
    return image / total


def test_against_spherical_excess_by_angles():
    mesh = curvlib.Mesh(*torus(16, "irregular"))
    normals, areas = normals_of(mesh)
    found = curvlib.estimate(mesh, "meek_walton").K
    np.testing.assert_allclose(found, by_angles(mesh, normals, areas), atol=1e-9)


def test_the_gauss_image_of_a_closed_mesh_covers_the_sphere_once_for_each_turn():
    """Sum of K A, each triangle at three vertices: 3 times 2 pi times the Euler characteristic."""
    for mesh in (
        curvlib.tessellate(curvlib.surface("ellipsoid"), 12),
        curvlib.Mesh(*torus(12, "irregular")),
    ):
        _, areas = normals_of(mesh)
        total = np.zeros(len(mesh.vertices))
        for k in range(3):
            np.add.at(total, mesh.faces[:, k], areas)
        edges = 3 * len(mesh.faces) // 2
        characteristic = len(mesh.vertices) - edges + len(mesh.faces)
        K = curvlib.estimate(mesh, "meek_walton").K
        assert abs((K * total).sum() / 3 - 2 * np.pi * characteristic) < 1e-9


def exact_normals(disk):
    return disk.exact_normal


spherical_image = estimators.module("meek_walton").estimate


def with_exact_normals(ball, exact_normals):
    return spherical_image(ball, exact_normals)


def test_order():
    """First order with exact normals on jittered meshes; not with those of the triangles."""
    errors = []
    for side in (40, 80):
        vertices, faces = torus(side, "irregular")
        x, y, z = vertices.T
        around = np.hypot(x, y)
        centre = 2 * np.column_stack((x / around, y / around, 0 * z))
        mesh = curvlib.Mesh(vertices, faces, normals=vertices - centre)
        K = (around - 2) / around
        found = (curvlib.estimate(mesh, e).K for e in (with_exact_normals, "meek_walton"))
        errors.append([np.abs(x - K).mean() for x in found])
    slopes = np.log2(np.divide(*errors))
    assert 0.8 < slopes[0] < 1.4
    assert slopes[1] < 0.5
