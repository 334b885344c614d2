"""The library on disk: every value comes back bit for bit in the readers that people have."""

import ctypes.util
import doctest
import errno
import os
import re
import shutil
import subprocess
import sys

import h5py
import meshio
import numpy as np
import pytest
import pyvista
import trimesh
from geomdl.exchange import import_json

import curvlib
from curvlib.dataset import library
from curvlib.dataset.library import mesh_files, nurbs_file
from curvlib.dataset.write import WRITERS, write_library, write_nurbs
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
    header = [
        line
        for line in files[".txt"].read_text(encoding="utf-8").splitlines()
        if line.startswith("#")
    ]
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


def test_a_resolution_is_a_number(folder):
    lib = curvlib.load_library(folder)
    for n in ("8", None, 8.0, [8]):
        with pytest.raises(curvlib.InputError, match=f"n is an int, not {re.escape(repr(n))}"):
            lib.mesh("sphere", n)
    with pytest.raises(curvlib.InputError, match="n is an int, not 'same'"):
        lib.mesh("sphere", "same", 8)
    assert len(lib.mesh("sphere", np.int64(8)).faces) == 112


def test_a_library_says_what_it_has(folder):
    lib = curvlib.load_library(folder)
    assert repr(lib).splitlines() == [
        "<Library of 12 meshes>",
        f"  surfaces: {', '.join(SURFACES)}",
        "  diagonals: jittered-1, same",
        "  n: 8, 12",
    ]
    assert repr(lib.only([("sphere", "same", 8)])).startswith("<Library of 1 mesh>")
    empty = lib.only([])
    assert repr(empty) == "<Library of 0 meshes>"
    with pytest.raises(curvlib.InputError, match="empty library: unknown surface"):
        empty.mesh("sphere", 8)


def test_asking_whether_a_mesh_is_there_reads_none(folder, monkeypatch):
    lib = curvlib.load_library(folder)
    monkeypatch.setattr(h5py, "File", lambda *a, **k: pytest.fail("a file was opened"))
    assert ("sphere", "same", 8) in lib
    assert ("sphere", "same", 9) not in lib


def test_reading_needs_no_writer():
    """Else a change of the PLY writer would change the digest of every estimate."""
    code = "import sys, curvlib.dataset.library; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = [name for name in done.stdout.split() if name.startswith("curvlib.")]
    assert "curvlib.dataset.vtkhdf" in loaded
    for name in ("dataset.formats", "dataset.write", "nurbs", "surfaces.sphere", "kit.compiled"):
        assert f"curvlib.{name}" not in loaded


def test_examples_run():
    found = doctest.testmod(library)
    assert found.attempted > 10
    assert found.failed == 0


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
    advice = "`curvlib fetch` gets a library, `snakemake` makes one in data/library"
    with pytest.raises(curvlib.InputError, match=f"{tmp_path}: no mesh library here; {advice}"):
        curvlib.load_library(tmp_path)
    with pytest.raises(curvlib.InputError, match=rf"none\.vtkhdf: no such file; {advice}"):
        curvlib.load_library(tmp_path / "none.vtkhdf")
    (tmp_path / "curvature-library-1.zip").write_bytes(b"PK")
    with pytest.raises(
        curvlib.InputError, match=r"1\.zip: cut off or no zip file; get the archive"
    ):
        curvlib.load_library(tmp_path / "curvature-library-1.zip")
    with pytest.raises(
        curvlib.InputError, match=r"x\.zip: no such file; did you mean .*-1\.zip'\?"
    ):
        curvlib.load_library(tmp_path / "x.zip")
    with h5py.File(tmp_path / "a.same.008.vtkhdf", "w"):
        pass
    with pytest.raises(curvlib.InputError, match=r"a\.same\.008\.vtkhdf: not the expected data"):
        curvlib.load_library(tmp_path / "a.same.008.vtkhdf").mesh("a", 8)


def test_the_home_folder(folder, monkeypatch):
    monkeypatch.setenv("HOME", str(folder.parent))
    assert len(curvlib.load_library(f"~/{folder.name}")) == 12


def test_a_file_with_faces_of_no_vertex_is_named(folder, tmp_path):
    path = shutil.copy(folder / "sphere/sphere.same.008.vtkhdf", tmp_path)
    with h5py.File(path, "r+") as file:
        file["VTKHDF/Polygons/Connectivity"][5] = 1000
    with pytest.raises(curvlib.InputError, match=r"008\.vtkhdf: not the expected data \(faces: "):
        curvlib.load_library(path).mesh("sphere", 8)


def test_nothing_half_written(tmp_path, monkeypatch):
    def fails(path, mesh, about):
        path.write_text("half")
        raise RuntimeError("in the middle")

    monkeypatch.setitem(WRITERS, ".txt", fails)
    with pytest.raises(RuntimeError, match="in the middle"):
        write_library(curvlib.surface("sphere"), [("same", 8)], tmp_path)
    names = sorted(p.name for p in tmp_path.rglob("*") if p.is_file())
    assert names == ["sphere.same.008.ply", "sphere.same.008.vtkhdf"]


def test_a_killed_run_leaves_no_mesh_of_the_library(folder, tmp_path):
    copy = shutil.copytree(folder / "sphere", tmp_path / "sphere")
    left = copy / "sphere.same.024.vtkhdf.x1y2z3.part"
    left.mkdir()
    (left / "sphere.same.024.vtkhdf").write_bytes(b"half")
    assert list(curvlib.load_library(tmp_path)) == [("sphere", *mesh) for mesh in MESHES]


@pytest.mark.parametrize("kind", WRITERS)
def test_a_full_disk_is_one_line(tmp_path, monkeypatch, kind):
    """The system gives no room for what is written to the file of this kind."""

    def full(file, *rest):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    target = "curvlib.files.Path.write_bytes" if kind == ".vtkhdf" else "builtins.open"
    write = WRITERS[kind]

    def write_on_full_disk(*arguments):
        with monkeypatch.context() as full_disk:
            full_disk.setattr(target, full)
            write(*arguments)

    monkeypatch.setitem(WRITERS, kind, write_on_full_disk)
    path = tmp_path / f"sphere/sphere.same.008{kind}"
    with pytest.raises(curvlib.InputError) as raised:
        write_library(curvlib.surface("sphere"), [("same", 8)], tmp_path)
    assert str(raised.value) == f"{path}: No space left on device"
    written = {p.suffix for p in tmp_path.rglob("*") if p.is_file()}
    assert written == set(list(WRITERS)[: list(WRITERS).index(kind)])
    assert not list(tmp_path.rglob("*.part"))


def test_a_label_on_several_lines_breaks_no_header(tmp_path):
    surface = curvlib.surface("sphere")
    surface.label = 'Sphere\n "\\" é'
    write_library(surface, [("same", 8)], tmp_path)
    mesh = curvlib.tessellate(surface, 8)
    vtkhdf, ply, text = (tmp_path / file for file in mesh_files("sphere", "same", 8))
    same(meshio.read(ply).points, mesh.vertices)
    same(np.loadtxt(text)[:, 3], mesh.K)
    for path in (ply, text):
        head = path.read_bytes().split(b"x y z")[0].decode("utf-8", errors="replace")
        assert 'surface: Sphere "\\" é (sphere)\n' in head
    with h5py.File(vtkhdf) as file:
        assert file.attrs["surface"] == 'Sphere\n "\\" é (sphere)'
