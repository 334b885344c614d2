"""The library on disk, estimates on disk: values come back bit for bit, or one clear error."""

import numpy as np
import pytest

import curvlib
from curvlib.library import whole_file, write_library
from curvlib.mesh import FIELDS
from curvlib.results import read_estimates, write_estimates


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("library")
    for name in ("sphere", "teapot_spout"):
        write_library(curvlib.surface(name), [8, 12], ["same", "alternate"], folder / f"{name}.h5")
    return folder


def test_what_was_written_is_read_back(folder):
    lib = curvlib.load_library(folder)
    assert lib.surfaces() == ["sphere", "teapot_spout"]
    assert len(lib) == 8
    for (name, diagonal, n), found in lib.items():
        made = curvlib.tessellate(curvlib.surface(name), n, diagonal)
        for field in ("vertices", "faces", "boundary", *FIELDS):
            np.testing.assert_array_equal(getattr(found, field), getattr(made, field))


def test_one_file_and_lazily(folder, monkeypatch):
    lib = curvlib.load_library(folder / "sphere.h5")
    assert lib.surfaces() == ["sphere"]
    read = []
    monkeypatch.setattr("curvlib.library.Mesh", lambda *a, **k: read.append(a))
    assert list(lib) == [("sphere", d, n) for d in ("alternate", "same") for n in (8, 12)]
    assert not read
    lib.mesh("sphere", 12)
    assert len(read) == 1


def test_text_is_the_paper_s(folder):
    """x y z K H^2 per vertex, 17 digits: the doubles come back."""
    mesh = curvlib.tessellate(curvlib.surface("teapot_spout"), 12)
    rows = np.loadtxt(folder / "teapot_spout" / "same-012.txt")
    np.testing.assert_array_equal(rows, np.column_stack((mesh.vertices, mesh.K, mesh.H**2)))
    assert np.isnan(rows[:, 3]).sum() == (~mesh.smooth).sum()


def test_unknown_mesh(folder):
    lib = curvlib.load_library(folder)
    with pytest.raises(curvlib.InputError, match="'spere'; did you mean 'sphere'"):
        lib.mesh("spere", 8)
    with pytest.raises(curvlib.InputError, match=r"unknown resolution '9'.*valid: 8, 12"):
        lib.mesh("sphere", 9)
    with pytest.raises(curvlib.InputError, match="'alternat'; did you mean 'alternate'"):
        lib.mesh("sphere", 8, "alternat")


@pytest.mark.parametrize("length", [0, 100, 5000])
def test_cut_off_file(folder, tmp_path, length):
    path = tmp_path / "sphere.h5"
    path.write_bytes((folder / "sphere.h5").read_bytes()[:length])
    with pytest.raises(curvlib.InputError, match=r"sphere\.h5: cut off or not HDF5"):
        curvlib.load_library(path)


def test_no_library(tmp_path):
    with pytest.raises(curvlib.InputError, match="no library here"):
        curvlib.load_library(tmp_path)
    with pytest.raises(curvlib.InputError, match="no library here"):
        curvlib.load_library(tmp_path / "none.h5")
    write_estimates(tmp_path / "other.h5", [])
    with pytest.raises(curvlib.InputError, match="not one of a mesh library"):
        curvlib.load_library(tmp_path / "other.h5")


def test_estimates_come_back(tmp_path):
    mesh = curvlib.tessellate(curvlib.surface("sphere"), 8)
    made = curvlib.estimate(mesh, "paraboloid")
    key = (("sphere", "same", 8), "normal=uniform")
    write_estimates(tmp_path / "e.h5", [(*key, made)], code="abc")
    found = read_estimates(tmp_path / "e.h5")
    assert list(found) == [key]
    for a, b in zip(found[key], made):
        np.testing.assert_array_equal(a, b)


def test_nothing_half_written(tmp_path):
    def fails():
        yield ("sphere", "same", 8), "-", curvlib.Estimates(np.zeros(3), np.zeros(3))
        raise RuntimeError("in the middle")

    with pytest.raises(RuntimeError, match="in the middle"):
        write_estimates(tmp_path / "e.h5", fails())
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "kept").write_text("before")
    with pytest.raises(RuntimeError), whole_file(tmp_path / "kept") as part:
        part.write_text("half")
        raise RuntimeError
    assert [p.name for p in tmp_path.iterdir()] == ["kept"]
    assert (tmp_path / "kept").read_text() == "before"
