"""Noise levels and staircases, on meshes made so."""

import numpy as np
import pytest
import pyvista
from scipy.spatial.transform import Rotation

from curvlib import Mesh, surface, tessellate
from curvlib.meshes.check import check
from curvlib.meshes.jittered import jittered
from curvlib.meshes.roughness import noise


def moved(mesh, sigma, isotropic=False):
    """A mesh with noise of sigma mean edges along its normals, or in all directions."""
    random = np.random.default_rng(2)
    if isotropic:
        moves = random.normal(size=mesh.vertices.shape)
    else:
        moves = random.normal(size=len(mesh.vertices))[:, None] * mesh.normals
    return mesh.moved(mesh.vertices + sigma * mesh.mean_edge * moves)


@pytest.mark.parametrize("isotropic", [False, True])
@pytest.mark.parametrize(
    "mesh",
    [jittered(name, 40, 3) for name in ("torus", "ellipsoid", "patch")]
    + [tessellate(surface(name), 40) for name in ("revolution", "sphere")],
    ids=["torus", "ellipsoid", "patch", "revolution", "sphere"],
)
def test_noise_is_told(mesh, isotropic):
    for sigma in (1e-3, 1e-2, 1e-1):
        assert noise(moved(mesh, sigma, isotropic)) == pytest.approx(sigma, rel=0.15)
    assert noise(mesh) < 4e-4


def test_noise_has_no_unit_and_no_place():
    mesh = moved(jittered("ellipsoid", 25), 0.01)
    expected = noise(mesh)
    turned = mesh.vertices @ Rotation.from_rotvec([1, 2, 3]).as_matrix()
    assert noise(mesh.moved(turned)) == pytest.approx(expected, rel=1e-6)
    for scale in (2.0**-900, 2.0**900):
        assert noise(mesh.moved(mesh.vertices * scale)) == expected


def test_noise_is_unknown_without_enough_rings():
    assert np.isnan(noise(Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])))
    assert np.isnan(noise(Mesh(np.zeros((0, 3)), np.zeros((0, 3), int))))
    soup = np.random.default_rng(0).normal(size=(300, 3))
    assert np.isnan(noise(Mesh(soup, np.arange(300).reshape(-1, 3))))


def voxels(radius=9.2, level=0.5):
    """Marching cubes of a ball of voxels: its points are halfway between voxels, or at them."""
    side = 2 * int(radius) + 5
    grid = pyvista.ImageData(dimensions=(side,) * 3, origin=(-(side // 2),) * 3)
    inside = np.linalg.norm(grid.points, axis=1)
    values = (inside <= radius).astype(float) if level else -inside
    data = grid.contour([level or -radius], values, method="marching_cubes")
    return Mesh(data.points, data.regular_faces)


def cuboids():
    """The faces of the voxels of a ball."""
    grid = pyvista.ImageData(dimensions=(21, 21, 21), origin=(-10, -10, -10))
    grid.cell_data["r"] = np.linalg.norm(grid.cell_centers().points, axis=1)
    inside = grid.threshold(9, scalars="r", invert=True)
    data = inside.extract_surface(algorithm="dataset_surface").triangulate()
    return Mesh(data.points, data.regular_faces)


@pytest.mark.parametrize("mesh", [voxels(), voxels(level=1.0), cuboids()])
def test_staircases_of_any_voxels_turned_or_not(mesh):
    turn = Rotation.from_rotvec([0.3, 1, 2]).as_matrix()
    for vertices in (
        mesh.vertices,
        mesh.vertices * (0.7, 0.7, 1.9),
        (mesh.vertices * (1, 1, 2) @ turn + 7).astype(np.float32),
    ):
        report = check(Mesh(vertices, mesh.faces))
        assert report.staircase
        assert 0.05 < report.noise < 0.6


def test_other_meshes_are_no_staircase():
    """Smooth marching cubes; a box and a tube, whose edges are few but flat; a noisy torus."""
    box = pyvista.Box(level=8).triangulate().clean()
    assert not check(voxels(level=0)).staircase
    assert not check(Mesh(box.points, box.regular_faces)).staircase
    assert not check(tessellate(surface("cylinder"), 32)).staircase
    assert not check(moved(jittered("torus", 30), 0.2)).staircase
