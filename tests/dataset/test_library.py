"""The library on disk: every value comes back bit for bit in the readers that people have."""

import ctypes.util
import shutil

import h5py
import meshio
import numpy as np
import pytest
import pyvista
import trimesh
from geomdl.exchange import import_json

import curvlib
from curvlib.dataset.library import mesh_files, nurbs_file
from curvlib.dataset.write import WRITERS, write_library, write_nurbs
from curvlib.files import whole_file
from curvlib.meshes.mesh import FIELDS

MESHES = [("jittered-1", 8), ("same", 8), ("same", 12)]
SURFACES = ["cone_apex", "ellipsoid", "sphere", "teapot_spout"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("library")
    for name in SURFACES:
        write_library(curvlib.surface(name), MESHES, folder)
    return folder


@pytest.fixture(params=SURFACES)
def written(request, folder):
    """A mesh, and its files by format."""
    files = mesh_files(request.param, "same", 12)
    mesh = curvlib.tessellate(curvlib.surface(request.param), 12)
    return mesh, dict(zip(WRITERS, (folder / file for file in files)))


def same(found, made):
    """Bit for bit, whatever NaN is."""
    np.testing.assert_array_equal(np.asarray(found), made)
    assert np.asarray(found).dtype.itemsize == np.asarray(made).dtype.itemsize


def test_what_was_written_is_read_back(folder):
    lib = curvlib.load_library(folder)
    assert lib.surfaces() == SURFACES
    assert list(lib) == [(name, *mesh) for name in SURFACES for mesh in MESHES]
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
    """MeshLab shows the property called `quality`. Its library loads only where the system has
    OpenGL; elsewhere meshio has to find the property."""
    mesh, files = written
    if ctypes.util.find_library("GL"):
        import pymeshlab

        meshes = pymeshlab.MeshSet()
        meshes.load_new_mesh(str(files[".ply"]))
        found = meshes.current_mesh()
        same(found.vertex_matrix(), mesh.vertices)
        np.testing.assert_array_equal(found.face_matrix(), mesh.faces)
        same(found.vertex_scalar_array(), mesh.K)
    else:
        same(meshio.read(files[".ply"]).point_data["quality"], mesh.K)


def test_text_is_the_paper_s(written):
    """x y z K H^2 per vertex, 17 digits: the doubles come back."""
    mesh, files = written
    rows = np.loadtxt(files[".txt"])
    same(rows, np.column_stack((mesh.vertices, mesh.K, mesh.H2)))
    assert np.isnan(rows[:, 3]).sum() == (~mesh.smooth).sum()
    header = [line for line in files[".txt"].read_text().splitlines() if line.startswith("#")]
    assert header[-1] == "# x y z K H^2"
    for word in ("1/length^2", "outward normal", "NaN", "NURBS"):
        assert word in "\n".join(header)


@pytest.mark.parametrize("name", SURFACES)
def test_geomdl_reads_the_surface(tmp_path, name):
    """It scales the knots to [0, 1]."""
    s = curvlib.surface(name)
    write_nurbs(s, tmp_path)
    (found,) = import_json(str(tmp_path / nurbs_file(name)))
    (u0, u1), (v0, v1) = s.domain
    for a, b in np.random.default_rng(0).random((20, 2)):
        point = s.point(u0 + (u1 - u0) * a, v0 + (v1 - v0) * b)
        np.testing.assert_allclose(found.evaluate_single((a, b)), point, atol=1e-13)


def test_one_file_wherever_it_lies(folder, tmp_path):
    copy = shutil.copy(folder / "teapot_spout/teapot_spout.same.012.vtkhdf", tmp_path)
    lib = curvlib.load_library(copy)
    assert list(lib) == [("teapot_spout", "same", 12)]
    assert len(lib.mesh("teapot_spout", 12).faces) == 288


def test_listing_opens_no_mesh(folder, monkeypatch):
    monkeypatch.setattr(h5py, "File", lambda *a, **k: pytest.fail("a file was opened"))
    assert len(curvlib.load_library(folder)) == len(SURFACES) * len(MESHES)


def test_diagonal_with_a_number(tmp_path, monkeypatch):
    """The name of a diagonal is what stands between surface and resolution."""
    monkeypatch.setattr(
        "curvlib.dataset.write.tessellate",
        lambda s, n, diagonal: curvlib.tessellate(s, n, "random"),
    )
    write_library(curvlib.surface("cone_apex"), [("random-1", 8)], tmp_path)
    assert list(curvlib.load_library(tmp_path)) == [("cone_apex", "random-1", 8)]


def test_unknown_mesh(folder):
    lib = curvlib.load_library(folder)
    with pytest.raises(curvlib.InputError, match="'spere'; did you mean 'sphere'"):
        lib.mesh("spere", 8)
    with pytest.raises(curvlib.InputError, match=r"sphere.*unknown resolution '9'.*valid: 8, 12"):
        lib.mesh("sphere", 9)
    with pytest.raises(curvlib.InputError, match="'jitterd-1'; did you mean 'jittered-1'"):
        lib.mesh("sphere", 8, "jitterd-1")


def test_part_of_a_library(folder):
    lib = curvlib.load_library(folder)
    keys = [("sphere", "same", 12), ("cone_apex", "jittered-1", 8)]
    assert list(lib.only(keys)) == keys
    with pytest.raises(curvlib.InputError, match="unknown resolution '64'"):
        lib.only([*keys, ("sphere", "same", 64)])


@pytest.mark.parametrize("length", [0, 100, 5000, 30000])
def test_cut_off_file(folder, tmp_path, length):
    whole = folder / "sphere/sphere.same.008.vtkhdf"
    path = tmp_path / whole.name
    path.write_bytes(whole.read_bytes()[:length])
    with pytest.raises(curvlib.InputError, match=r"sphere\.same\.008\.vtkhdf: cut off or not HDF5"):
        curvlib.load_library(path).mesh("sphere", 8)


def test_no_library(tmp_path):
    with pytest.raises(curvlib.InputError, match="no mesh library here"):
        curvlib.load_library(tmp_path)
    with pytest.raises(curvlib.InputError, match="no mesh library here"):
        curvlib.load_library(tmp_path / "none.vtkhdf")
    (tmp_path / "other.zip").write_bytes(b"PK")
    with pytest.raises(curvlib.InputError, match="cut off or no zip file"):
        curvlib.load_library(tmp_path / "other.zip")
    with h5py.File(tmp_path / "a.same.008.vtkhdf", "w"):
        pass
    with pytest.raises(curvlib.InputError, match=r"a\.same\.008\.vtkhdf: not a mesh of a library"):
        curvlib.load_library(tmp_path / "a.same.008.vtkhdf").mesh("a", 8)


def test_nothing_half_written(tmp_path, monkeypatch):
    def fails(path, mesh, about):
        path.write_text("half")
        raise RuntimeError("in the middle")

    monkeypatch.setitem(WRITERS, ".txt", fails)
    with pytest.raises(RuntimeError, match="in the middle"):
        write_library(curvlib.surface("sphere"), [("same", 8)], tmp_path)
    names = sorted(p.name for p in tmp_path.rglob("*") if p.is_file())
    assert names == ["sphere.same.008.ply", "sphere.same.008.vtkhdf"]
    (tmp_path / "kept").write_text("before")
    with pytest.raises(RuntimeError), whole_file(tmp_path / "kept") as part:
        part.write_text("half")
        raise RuntimeError
    assert not list(tmp_path.glob("*.part"))
    assert (tmp_path / "kept").read_text() == "before"
