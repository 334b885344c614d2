"""A mesh that was changed since it was made is told, at no cost for those that were not."""

import hashlib
import os
import shutil

import h5py
import pytest

import curvlib
from curvlib.dataset import sums
from curvlib.dataset.write import write_library


@pytest.fixture
def library(tmp_path):
    write_library(curvlib.surface("sphere"), [("same", 8), ("same", 12)], tmp_path)
    return tmp_path


def change(library):
    """Move one vertex, as a script would."""
    path = library / "sphere/sphere.same.008.vtkhdf"
    with h5py.File(path, "r+") as file:
        file["VTKHDF/Points"][0] += 1e-3
    return path


def test_a_changed_mesh_is_named(library):
    path = change(library)
    meshes = curvlib.load_library(library)
    assert meshes.mesh("sphere", 12)
    with pytest.raises(curvlib.InputError, match=r"008\.vtkhdf: changed since it was made"):
        meshes.mesh("sphere", 8)
    path.unlink()
    write_library(curvlib.surface("sphere"), [("same", 8), ("same", 12)], library)
    assert meshes.mesh("sphere", 8)


def test_a_copied_library_is_the_same(library, tmp_path_factory):
    """Files that are younger than the sums, with the bytes that these list."""
    copy = shutil.copytree(library, tmp_path_factory.mktemp("copy") / "library")
    os.utime(copy / "sphere/sphere.same.008.vtkhdf")
    assert curvlib.load_library(copy).mesh("sphere", 8)
    (change(copy).with_name(sums.SUMS)).unlink()
    assert curvlib.load_library(copy).mesh("sphere", 8), "without sums nothing is known"


def test_meshes_older_than_the_sums_are_not_hashed(library, monkeypatch):
    os.utime(library / "sphere/sphere.same.008.vtkhdf", (10**9, 10**9))
    monkeypatch.setattr(sums, "file_hash", lambda path: pytest.fail("hashed"))
    assert curvlib.load_library(library).mesh("sphere", 8)


def test_sums_are_written_as_sha256sum_reads_them(library):
    folder = library / "sphere"
    lines = (folder / "SHA256SUMS").read_text(encoding="utf-8").splitlines()
    names = ["sphere.same.008.vtkhdf", "sphere.same.012.vtkhdf"]
    hashes = [hashlib.sha256((folder / name).read_bytes()).hexdigest() for name in names]
    assert lines == [f"{digest}  {name}" for digest, name in zip(hashes, names)]
