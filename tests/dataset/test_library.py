"""Loading a library: its meshes, and what it says of those it does not have."""

import doctest
import re
import shutil
import subprocess
import sys

import h5py
import numpy as np
import pytest

import curvlib
from curvlib.dataset import library


def test_one_file_wherever_it_lies(folder, tmp_path):
    copy = shutil.copy(folder / "teapot_spout/teapot_spout.same.012.vtkhdf", tmp_path)
    lib = curvlib.load_library(copy)
    assert list(lib) == [("teapot_spout", "same", 12)]
    assert len(lib.mesh("teapot_spout", 12).faces) == 288


def test_listing_opens_no_mesh(folder, keys, monkeypatch):
    monkeypatch.setattr(h5py, "File", lambda *a, **k: pytest.fail("a file was opened"))
    assert list(curvlib.load_library(folder)) == keys


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


def test_what_names_no_mesh(folder):
    lib = curvlib.load_library(folder)
    for surface, diagonal in ((["sphere"], "same"), ("sphere", {}), (np.array("sphere"), "same")):
        with pytest.raises(curvlib.InputError, match=r"unknown (surface|diagonal) .*; valid: "):
            lib.mesh(surface, 8, diagonal)
    for key in ("a", ("sphere", 8), None):
        with pytest.raises(curvlib.InputError, match=r"a mesh is \(surface, diagonal, n\), not "):
            lib.only([key])
    assert len(lib.only([["sphere", "same", 8]])) == 1


def test_what_is_no_path(folder):
    for path in (None, 3, [folder]):
        with pytest.raises(curvlib.InputError, match="a path is expected, not "):
            curvlib.load_library(path)
    with pytest.raises(curvlib.InputError, match="File name too long"):
        curvlib.load_library("a" * 5000)


def test_a_library_says_what_it_has(folder):
    lib = curvlib.load_library(folder)
    assert repr(lib).splitlines() == [
        "<Library of 12 meshes>",
        "  surfaces: cone_apex, ellipsoid, sphere, teapot_spout",
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
