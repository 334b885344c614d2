"""The library on disk, estimates on disk: values come back bit for bit, or one clear error."""

from types import SimpleNamespace

import h5py
import numpy as np
import pandas as pd
import pytest

import curvlib
from curvlib.library import whole_file, write_library
from curvlib.mesh import FIELDS
from curvlib.results import read_values, run_estimator


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("library")
    for name in ("sphere", "teapot_spout"):
        meshes = [(diagonal, n) for diagonal in ("same", "random-1") for n in (8, 12)]
        write_library(curvlib.surface(name), meshes, folder / f"{name}.h5")
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
    assert list(lib) == [("sphere", d, n) for d in ("random-1", "same") for n in (8, 12)]
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
    with pytest.raises(curvlib.InputError, match="'sam'; did you mean 'same'"):
        lib.mesh("sphere", 8, "sam")


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
    h5py.File(tmp_path / "other.h5", "w").close()
    with pytest.raises(curvlib.InputError, match="not one of a mesh library"):
        curvlib.load_library(tmp_path / "other.h5")


@pytest.fixture
def run(folder, tmp_path):
    """Runs an estimator on the library, all variants on n = 8 alone."""

    def run(meshes, variants):
        names = ("sphere", "teapot_spout")
        output = SimpleNamespace(values=tmp_path / "e.h5", errors=tmp_path / "e.csv")
        surfaces = {name: curvlib.surface(name) for name in names}
        run_estimator("watanabe_b", variants, meshes, surfaces, {("same", 8)}, output, code="x")
        return output

    return run


VARIANTS = {"normal=uniform": {"normal": "uniform"}, "normal=area": {"normal": "area"}}


def test_estimates_come_back(folder, run):
    lib = curvlib.load_library(folder)
    output = run(lib, VARIANTS)
    found = read_values(output.values)
    assert list(found) == [(s, "same", 8) for s in ("sphere", "teapot_spout")]
    for key, values in found.items():
        for a, b in zip(values, curvlib.estimate(lib[key], "watanabe_b")):
            np.testing.assert_array_equal(a, b)
    errors = pd.read_csv(output.errors)
    assert set(errors.variant[(errors.diagonal == "same") & (errors.n == 8)]) == set(VARIANTS)
    assert set(errors.variant[errors.n == 12]) == {"normal=uniform"}
    assert set(errors.counted[errors.surface == "sphere"]) == {"interior", "without-poles"}
    assert set(errors.counted[errors.surface == "teapot_spout"]) == {"interior"}


def test_nothing_half_written(folder, run, tmp_path):
    lib = dict(curvlib.load_library(folder))
    lib["sphere", "same", 8] = None
    with pytest.raises(AttributeError):
        run(lib, VARIANTS)
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "kept").write_text("before")
    with pytest.raises(RuntimeError), whole_file(tmp_path / "kept") as part:
        part.write_text("half")
        raise RuntimeError
    assert [p.name for p in tmp_path.iterdir()] == ["kept"]
    assert (tmp_path / "kept").read_text() == "before"
