"""The files of a mesh: every value comes back bit for bit in the readers that people have."""

import importlib.util

import h5py
import meshio
import numpy as np
import pytest
import pyvista
import trimesh
from geomdl.exchange import import_json

import curvlib
from curvlib.dataset.library import nurbs_file
from curvlib.dataset.write import write_nurbs
from curvlib.meshes.mesh import FIELDS


def same(found, made):
    """Bit for bit, whatever NaN is."""
    np.testing.assert_array_equal(np.asarray(found), made)
    assert np.asarray(found).dtype.itemsize == np.asarray(made).dtype.itemsize


def test_what_was_written_is_read_back(folder, keys):
    lib = curvlib.load_library(folder)
    assert lib.surfaces() == sorted({surface for surface, _, _ in keys})
    assert list(lib) == keys
    for (name, diagonal, n), found in lib.items():
        made = curvlib.tessellate(curvlib.surface(name), n, diagonal)
        for field in ("vertices", "faces", "boundary", "H2", *FIELDS):
            same(getattr(found, field), getattr(made, field))


def test_pyvista_reads_everything(written):
    mesh, files = written
    found = pyvista.read(files[".vtkhdf"])
    same(found.points, mesh.vertices)
    np.testing.assert_array_equal(found.regular_faces, mesh.faces)
    assert found.n_cells == len(mesh.faces)
    values = {name: getattr(mesh, name) for name in (*FIELDS, "boundary")} | {"H2": mesh.H2}
    assert set(found.point_data) == set(values)
    for name, made in values.items():
        same(found[name], made)


def test_plain_h5py_reads_everything(written):
    mesh, files = written
    with h5py.File(files[".vtkhdf"]) as file:
        root = file["VTKHDF"]
        assert root.attrs["Type"] == b"PolyData"
        same(root["Points"], mesh.vertices)
        np.testing.assert_array_equal(root["Polygons/Connectivity"], mesh.faces.ravel())
        for name in ("K", "H", "k1", "k2", "d1", "d2", "normals", "uv"):
            same(root["PointData"][name], getattr(mesh, name))
        assert "1/length^2" in file.attrs["values"]


def test_meshio_reads_ply(written):
    mesh, files = written
    found = meshio.read(files[".ply"])
    same(found.points, mesh.vertices)
    np.testing.assert_array_equal(found.cells_dict["triangle"], mesh.faces)
    for name, made in (("K", mesh.K), ("H2", mesh.H2), ("nx", mesh.normals[:, 0])):
        same(found.point_data[name], made)


def test_trimesh_reads_ply(written):
    mesh, files = written
    found = trimesh.load(files[".ply"], process=False)
    same(found.vertices, mesh.vertices)
    np.testing.assert_array_equal(found.faces, mesh.faces)
    raw = found.metadata["_ply_raw"]["vertex"]["data"]
    same(raw["K"].ravel(), mesh.K)
    same(raw["H2"].ravel(), mesh.H2)


def test_meshlab_reads_ply(written):
    """MeshLab shows the property called `quality`: in its library, where `make peers` installed it,
    and by that name in meshio."""
    mesh, files = written
    same(meshio.read(files[".ply"]).point_data["quality"], mesh.K)
    if importlib.util.find_spec("pymeshlab"):
        import pymeshlab

        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(files[".ply"]))
        found = meshes.current_mesh()
        same(found.vertex_matrix(), mesh.vertices)
        np.testing.assert_array_equal(found.face_matrix(), mesh.faces)
        same(found.vertex_scalar_array(), mesh.K)


def test_text_is_the_paper_s(written):
    """x y z K H^2 per vertex, 17 digits: the doubles come back."""
    mesh, files = written
    rows = np.loadtxt(files[".txt"])
    same(rows, np.column_stack((mesh.vertices, mesh.K, mesh.H2)))
    assert np.isnan(rows[:, 3]).sum() == (~mesh.smooth).sum()
    header = [
        line
        for line in files[".txt"].read_text(encoding="utf-8").splitlines()
        if line.startswith("#")
    ]
    assert header[-1] == "# x y z K H^2"
    for word in ("1/length^2", "outward normal", "NaN", "NURBS"):
        assert word in "\n".join(header)


@pytest.mark.parametrize("name", curvlib.surfaces())
def test_geomdl_reads_the_surface(tmp_path, name):
    """It scales the knots to [0, 1]."""
    s = curvlib.surface(name)
    write_nurbs(s, tmp_path)
    (found,) = import_json(str(tmp_path / nurbs_file(name)))
    (u0, u1), (v0, v1) = s.domain
    for a, b in np.random.default_rng(0).random((20, 2)):
        point = s.point(u0 + (u1 - u0) * a, v0 + (v1 - v0) * b)
        np.testing.assert_allclose(found.evaluate_single((a, b)), point, atol=1e-13)
