"""Meshes of other libraries: their points in their order, or advice that works."""

import warnings
from types import SimpleNamespace

import numpy as np
import pytest
import pyvista
import trimesh

import curvlib
from curvlib.meshes.exchange import as_mesh


@pytest.fixture
def ball():
    return pyvista.Icosphere(radius=1, nsub=2)


def K(mesh):
    return curvlib.estimate(mesh, "gauss_bonnet").K


def test_triangles_beside_lines_and_points(ball):
    right = K(ball)
    ball.lines = np.array([2, 0, 1, 3, 4, 5, 6])
    ball.verts = np.array([1, 0])
    np.testing.assert_array_equal(K(ball), right)


def test_ghost_cells_are_left_out(ball):
    right, faces = K(ball), ball.regular_faces
    for lines in (None, np.array([2, 0, 1])):
        twice = pyvista.PolyData.from_regular_faces(ball.points, np.vstack([faces, faces[:10]]))
        if lines is not None:
            twice.lines = lines
        ghost = np.zeros(twice.n_cells, np.uint8)
        ghost[-10:-5], ghost[-5:] = 1, 32
        twice.cell_data["vtkGhostType"] = ghost
        np.testing.assert_array_equal(K(twice), right)


def test_point_normals_of_a_polydata_are_used(ball):
    with pytest.raises(curvlib.InputError, match="needs a mesh with normals"):
        curvlib.estimate(ball, "taubin", normal="exact")
    ball.point_data.active_normals = np.asarray(ball.points)
    found = curvlib.estimate(ball, "taubin", normal="exact")
    direct = curvlib.Mesh(ball.points, ball.regular_faces, normals=ball.points)
    np.testing.assert_array_equal(found.H, curvlib.estimate(direct, "taubin", normal="exact").H)


def test_quads_are_told_what_makes_triangles_of_them():
    plane = pyvista.Plane()
    with pytest.raises(curvlib.InputError, match=r"pass its \.triangulate\(\)"):
        K(plane)
    assert np.nanmax(np.abs(K(plane.triangulate()))) < 1e-12


def test_an_unstructured_grid_of_triangles_keeps_its_order(ball):
    points = ball.points[::-1].copy()
    faces = len(points) - 1 - ball.regular_faces
    cells = np.hstack([np.full((len(faces), 1), 3), faces])
    kinds = np.full(len(faces), pyvista.CellType.TRIANGLE)
    right = K((points, faces))
    np.testing.assert_array_equal(K(pyvista.UnstructuredGrid(cells.ravel(), kinds, points)), right)
    with_line = np.concatenate([cells.ravel(), [2, 0, 1]])
    kinds = np.append(kinds, pyvista.CellType.LINE)
    np.testing.assert_array_equal(K(pyvista.UnstructuredGrid(with_line, kinds, points)), right)


def test_other_cells_are_told_that_their_points_are_renumbered():
    image = pyvista.ImageData(dimensions=(4, 4, 4))
    for data in (image, image.cast_to_unstructured_grid()):
        with pytest.raises(curvlib.InputError, match="vtkOriginalPointIds") as error:
            K(data)
        assert "pass its .extract_surface().triangulate()" in str(error.value)
    surface = data.extract_surface(algorithm="dataset_surface").triangulate()
    assert "vtkOriginalPointIds" in surface.point_data
    assert np.isfinite(K(surface)).all()


def test_trimesh_and_its_scenes(ball):
    solid = trimesh.Trimesh(ball.points, ball.regular_faces, process=False)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        np.testing.assert_array_equal(K(solid), K((np.float64(ball.points), ball.regular_faces)))
    np.testing.assert_array_equal(K(trimesh.Scene([solid])), K(solid))


def test_a_meshio_mesh_of_triangles(ball):
    cells = {"triangle": ball.regular_faces, "line": np.array([[0, 1]])}
    mesh = SimpleNamespace(points=ball.points, cells_dict=cells, cell_sets={})
    np.testing.assert_array_equal(K(mesh), K(ball))
    cells["tetra"] = np.array([[0, 1, 2, 3]])
    with pytest.raises(curvlib.InputError, match="cells of type tetra"):
        K(mesh)


@pytest.mark.parametrize("kind", [np.float32, np.float64])
def test_coordinates_too_coarse_for_their_edges(ball, kind):
    far = (ball.points + np.array([500000.0, 5400000.0, 200.0])).astype(kind)
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        as_mesh((far, ball.regular_faces))
        as_mesh((np.asarray(ball.points, kind), ball.regular_faces))
    assert len(heard) == (kind == np.float32)
    if heard:
        assert "multiples of 0.5" in str(heard[0].message)
