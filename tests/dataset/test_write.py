"""Writing the library: whole files or none, on a full disk too."""

import errno
import os
import shutil

import h5py
import meshio
import numpy as np
import pytest

import curvlib
from curvlib.dataset.library import mesh_files
from curvlib.dataset.write import WRITERS, write_library


def test_nothing_half_written(tmp_path, monkeypatch):
    def fails(path, mesh, about):
        path.write_text("half")
        raise RuntimeError("in the middle")

    monkeypatch.setitem(WRITERS, ".txt", fails)
    with pytest.raises(RuntimeError, match="in the middle"):
        write_library(curvlib.surface("sphere"), [("same", 8)], tmp_path)
    names = sorted(p.name for p in tmp_path.rglob("*") if p.is_file())
    assert names == ["sphere.same.008.ply", "sphere.same.008.vtkhdf"]


def test_a_killed_run_leaves_no_mesh_of_the_library(folder, keys, tmp_path):
    copy = shutil.copytree(folder / "sphere", tmp_path / "sphere")
    left = copy / "sphere.same.024.vtkhdf.x1y2z3.part"
    left.mkdir()
    (left / "sphere.same.024.vtkhdf").write_bytes(b"half")
    whole = [key for key in keys if key[0] == "sphere"]
    assert list(curvlib.load_library(tmp_path)) == whole


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
    np.testing.assert_array_equal(meshio.read(ply).points, mesh.vertices)
    np.testing.assert_array_equal(np.loadtxt(text)[:, 3], mesh.K)
    for path in (ply, text):
        head = path.read_bytes().split(b"x y z")[0].decode("utf-8", errors="replace")
        assert 'surface: Sphere "\\" é (sphere)\n' in head
    with h5py.File(vtkhdf) as file:
        assert file.attrs["surface"] == 'Sphere\n "\\" é (sphere)'


def test_diagonal_with_a_number(tmp_path, monkeypatch):
    """The name of a diagonal is what stands between surface and resolution."""
    monkeypatch.setattr(
        "curvlib.dataset.write.tessellate",
        lambda s, n, diagonal: curvlib.tessellate(s, n, "random"),
    )
    write_library(curvlib.surface("cone_apex"), [("random-1", 8)], tmp_path)
    assert list(curvlib.load_library(tmp_path)) == [("cone_apex", "random-1", 8)]
