"""Implicit surfaces: derivatives, curvature, nearest points, marching cubes and voxels."""

import mpmath
import numpy as np
import pytest

from curvlib.catalogue import implicit
from curvlib.implicit._exact import exact, exact_mesh, nearest
from curvlib.implicit._sampled import marching_cubes, voxels
from curvlib.meshes.jittered import jittered

mp = mpmath.mp

# Each function once more, for arithmetic of any precision.
FUNCTIONS = {
    "ellipsoid": lambda x, y, z: x**2 + y**2 / mp.mpf("0.64") + z**2 / mp.mpf("0.36") - 1,
    "genus_3": lambda x, y, z: (
        (x**2 + y**2 + z**2) ** 2 - 2 * (x**2 + y**2 + z**2) + mp.mpf(4) / 5 - 2 * x * y * z
    ),
    "goursat": lambda x, y, z: x**4 + y**4 + z**4 - (x**2 + y**2 + z**2 + 1) / 2,
    "gyroid": lambda x, y, z: mp.sin(x) * mp.cos(y) + mp.sin(y) * mp.cos(z) + mp.sin(z) * mp.cos(x),
    "patch": lambda x, y, z: z - x**2 / 2 + 3 * y**2 / 10 - 3 * mp.sin(3 * x) * mp.cos(2 * y) / 20,
    "sphere": lambda x, y, z: x**2 + y**2 + z**2 - 1,
    "torus": lambda x, y, z: (mp.sqrt(x**2 + y**2) - 2) ** 2 + z**2 - mp.mpf("0.49"),
}


@pytest.mark.parametrize("surface", implicit.names())
def test_derivatives_are_those_of_the_function(surface):
    points = np.random.default_rng(1).uniform(0.2, 1.0, (3, 5))
    f, gradient, hessian = implicit.module(surface).level(*points)
    with mp.workdps(50):
        for k, p in enumerate(points.T):
            at, function = tuple(map(mp.mpf, p)), FUNCTIONS[surface]
            assert f[k] == pytest.approx(float(function(*at)), abs=1e-13)
            for i in range(3):
                one = np.eye(3, dtype=int)[i]
                first = float(mp.diff(function, at, tuple(map(int, one))))
                assert gradient[i, k] == pytest.approx(first, abs=1e-11)
                for j in range(3):
                    two = tuple(map(int, one + np.eye(3, dtype=int)[j]))
                    second = float(mp.diff(function, at, two))
                    assert hessian[i, j, k] == pytest.approx(second, abs=1e-10)


def test_curvature_of_the_torus_is_that_of_its_parameters():
    rng = np.random.default_rng(2)
    u, v = rng.uniform(0, 2 * np.pi, (2, 200))
    around = 2 + 0.7 * np.cos(v)
    points = np.stack((around * np.cos(u), around * np.sin(u), 0.7 * np.sin(v)), -1)
    found = exact("torus", points)
    np.testing.assert_allclose(found["k1"], 1 / 0.7, rtol=1e-12)
    np.testing.assert_allclose(found["k2"], np.cos(v) / around, atol=1e-13)
    tube = np.stack((-np.sin(v) * np.cos(u), -np.sin(v) * np.sin(u), np.cos(v)), -1)
    np.testing.assert_allclose(np.abs((found["d1"] * tube).sum(1)), 1, atol=1e-12)
    assert ((found["normals"] * points).sum(1) > 0)[np.cos(v) > 0].all()


def test_curvature_of_the_ellipsoid_by_its_support():
    """K = (p^2 / (a b c))^2 and H by Darboux, p the distance of the tangent plane."""
    a, b, c = 1.0, 0.8, 0.6
    rays = np.random.default_rng(3).standard_normal((200, 3))
    points = rays / np.linalg.norm(rays, axis=1)[:, None] * (a, b, c)
    x, y, z = points.T
    support = ((x / a**2) ** 2 + (y / b**2) ** 2 + (z / c**2) ** 2) ** -0.5
    found = exact("ellipsoid", points)
    np.testing.assert_allclose(found["K"], (support**2 / (a * b * c)) ** 2, rtol=1e-12)
    squares = a * a + b * b + c * c - (points**2).sum(1)
    np.testing.assert_allclose(
        found["H"], support**3 * squares / (2 * (a * b * c) ** 2), rtol=1e-12
    )


@pytest.mark.parametrize("surface", ["torus", "ellipsoid", "patch"])
def test_the_same_as_on_the_meshes_in_closed_form(surface):
    mesh = jittered(surface, 20, 4)
    found = exact(surface, mesh.vertices)
    for name in ("K", "H", "k1", "k2", "normals"):
        np.testing.assert_allclose(found[name], getattr(mesh, name), rtol=1e-9, atol=1e-9)
    turned = np.abs((found["d1"] * mesh.d1).sum(1))
    assert (turned > 1 - 1e-9)[mesh.k1 - mesh.k2 > 1e-3].all()


@pytest.mark.parametrize("surface", implicit.names())
def test_nearest_points_are_reached_along_normals(surface):
    on = marching_cubes(surface, 20, 5)
    foot = nearest(surface, on.vertices)
    reach = np.minimum(0.3 / np.abs([on.k1, on.k2]).max(0), 0.1)
    side = np.random.default_rng(5).uniform(-1, 1, len(reach))
    normals = exact(surface, foot)["normals"]
    points = foot + (reach * side)[:, None] * normals
    found = nearest(surface, points)
    f, _, _ = implicit.module(surface).level(*found.T)
    assert np.abs(f).max() < 1e-11
    # Where the surface is thin, another side of it may be nearer.
    same = np.abs(found - foot).max(1) < 1e-8
    assert same.mean() > 0.995
    assert (np.linalg.norm(found - points, axis=1) <= np.abs(reach * side) + 1e-8).all()


def test_a_point_without_nearest_point_is_nan():
    mesh = exact_mesh("sphere", [[2.0, 0, 0], [0, 1, 0], [0, 0, 0]], [[0, 1, 2]])
    assert mesh.smooth.tolist() == [True, True, False]
    assert np.isnan(mesh.K).tolist() == [False, False, True]


def euler(mesh):
    ends = np.sort(np.concatenate([mesh.faces[:, [k, (k + 1) % 3]] for k in range(3)]), 1)
    return len(mesh.vertices) - len(np.unique(ends, axis=0)) + len(mesh.faces)


EULER = {"sphere": 2, "ellipsoid": 2, "goursat": 2, "torus": 0, "genus_3": -4}


@pytest.mark.parametrize("make", [marching_cubes, voxels])
@pytest.mark.parametrize("surface", EULER)
def test_closed_meshes_have_the_genus_of_their_surface(surface, make):
    mesh = make(surface, 36, 6)
    assert euler(mesh) == EULER[surface]
    assert not mesh.boundary.any()


@pytest.mark.parametrize("surface", implicit.names())
def test_where_marching_cubes_and_voxels_lie(surface):
    fine, coarse = (marching_cubes(surface, n, 7) for n in (48, 24))
    away = [
        np.linalg.norm(nearest(surface, mesh.vertices) - mesh.vertices, axis=1)
        for mesh in (fine, coarse)
    ]
    assert away[0].mean() < away[1].mean() / 3  # interpolation is of second order
    stairs = voxels(surface, 24, 7)
    step = 2 * max(implicit.module(surface).BOX) / 24
    f, _, _ = implicit.module(surface).level(*stairs.vertices.T)
    assert (f <= 1e-6).all()
    places = (stairs.vertices - stairs.vertices[0]) / step
    np.testing.assert_allclose(places, np.round(places), atol=1e-4)
    for mesh in (fine, stairs):
        a, b, c = mesh.vertices[mesh.faces].swapaxes(0, 1)
        outward = (np.cross(b - a, c - a) * mesh.normals[mesh.faces[:, 0]]).sum(1)
        assert (outward > -1e-12).mean() > 0.99
