"""Files of meshes with values: what other libraries read back."""

import nibabel
import numpy as np
import pandas
import pytest
import pyvista
import trimesh

import curvlib
from curvlib.columns import DERIVED, columns
from curvlib.meshes.writing import WRITERS, write


@pytest.fixture(scope="module")
def estimates():
    return curvlib.estimate(curvlib.tessellate(curvlib.surface("ellipsoid"), 8), "jet")


@pytest.fixture(scope="module")
def named(estimates):
    return columns(estimates)


@pytest.mark.parametrize("suffix", [".vtp", ".vtk", ".vtkhdf", ".ply"])
def test_what_pyvista_reads(estimates, named, suffix, tmp_path):
    path = tmp_path / f"values{suffix}"
    write(path, estimates.mesh, named)
    data = pyvista.read(path)
    # VTK's reader of PLY rounds points to float32 and leaves most values out.
    np.testing.assert_allclose(data.points, estimates.mesh.vertices, atol=1e-6)
    np.testing.assert_array_equal(data.regular_faces, estimates.mesh.faces)
    if suffix != ".ply":
        assert set(named) == {"K", "H", "k1", "k2", "d1", "d2", *DERIVED}
        for name, values in named.items():
            np.testing.assert_array_equal(data.point_data[name], values)


def test_ply_has_the_value_that_meshlab_shows(estimates, named, tmp_path):
    write(tmp_path / "values.ply", estimates.mesh, named)
    mesh = trimesh.load_mesh(tmp_path / "values.ply", process=False)
    read = mesh.metadata["_ply_raw"]["vertex"]["data"]
    for name, values in {
        "quality": estimates.K,
        "H": estimates.H,
        "d1_y": named["d1"][:, 1],
    }.items():
        np.testing.assert_array_equal(read[name].reshape(-1), values)


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
def test_tables(estimates, named, suffix, tmp_path):

    path = tmp_path / f"values{suffix}"
    write(path, estimates.mesh, named)
    table = pandas.read_csv(path) if suffix == ".csv" else pandas.read_parquet(path)
    assert list(table)[:6] == ["x", "y", "z", "K", "H", "k1"]
    np.testing.assert_array_equal(table[["x", "y", "z"]], estimates.mesh.vertices)
    np.testing.assert_array_equal(table.H, estimates.H)
    np.testing.assert_array_equal(table[["d2_x", "d2_y", "d2_z"]], estimates.d2)


def test_overlays_of_gifti_and_freesurfer(estimates, named, tmp_path):
    write(tmp_path / "lh.shape.gii", estimates.mesh, named)
    image = nibabel.load(tmp_path / "lh.shape.gii")
    read = {array.meta["Name"]: array.data for array in image.darrays}
    np.testing.assert_array_equal(read["k2"], estimates.k2.astype(np.float32))
    write(tmp_path / "lh.curv", estimates.mesh, named)
    H = nibabel.freesurfer.read_morph_data(tmp_path / "lh.curv")
    np.testing.assert_array_equal(H, estimates.H.astype(np.float32))


def test_values_of_triangles_are_cell_data(tmp_path):
    mesh = curvlib.tessellate(curvlib.surface("ellipsoid"), 8)
    r = curvlib.estimate(mesh, "tensor_voting", per="face")
    for suffix in (".vtp", ".vtkhdf"):
        write(tmp_path / f"values{suffix}", mesh, columns(r), "face")
        data = pyvista.read(tmp_path / f"values{suffix}")
        np.testing.assert_array_equal(data.cell_data["K"], r.K)
        assert "K" not in data.point_data
    write(tmp_path / "values.csv", mesh, columns(r), "face")
    assert len(pandas.read_csv(tmp_path / "values.csv")) == len(mesh.faces)
    write(tmp_path / "values.ply", mesh, columns(r), "face")
    raw = trimesh.load_mesh(tmp_path / "values.ply", process=False).metadata["_ply_raw"]
    np.testing.assert_array_equal(raw["face"]["data"]["quality"], r.K)


def test_pycurv_names(estimates):
    mesh = curvlib.tessellate(curvlib.surface("ellipsoid"), 8)
    table = curvlib.estimate(mesh, "tensor_voting", per="face").to_dataframe("pycurv")
    vectors = [f"{name}_{axis}" for name in ("t_1", "t_2") for axis in "xyz"]
    scalars = ["kappa_1", "kappa_2", "gauss_curvature_VV", "mean_curvature_VV"]
    scalars += ["shape_index_VV", "curvedness_VV"]
    normals = ["n_v_x", "n_v_y", "n_v_z"]
    assert list(table) == [*scalars, *vectors, "area", *normals]
    mine = trimesh.Trimesh(mesh.vertices, mesh.faces, process=False)
    np.testing.assert_allclose(table.area, mine.area_faces, rtol=1e-12)
    np.testing.assert_allclose(table[normals], mine.face_normals, atol=1e-12)
    with pytest.raises(curvlib.InputError, match="per triangle"):
        columns(estimates, "pycurv")


@pytest.mark.parametrize("suffix", [".vtp", ".ply", ".csv", ".vtkhdf", ".gii", ".curv"])
def test_nothing_is_left_of_a_file_that_fails(estimates, suffix, tmp_path, monkeypatch):
    """A disk that is full in the middle."""
    writer = WRITERS[suffix]

    def fails(path, *arguments):
        writer(path, *arguments)
        raise OSError(28, "No space left on device")

    monkeypatch.setitem(WRITERS, suffix, fails)
    with pytest.raises(curvlib.InputError, match="No space left"):
        write(tmp_path / f"values{suffix}", estimates.mesh, columns(estimates))
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("name", "per", "words"),
    [
        ("values.stl", "vertex", "cannot tell the format by its suffix; known: .vtp"),
        ("values.gii", "face", "no place for values of triangles"),
        ("", "vertex", "is a folder"),
    ],
)
def test_wrong_paths(estimates, name, per, words, tmp_path):
    with pytest.raises(curvlib.InputError, match=words):
        write(tmp_path / name, estimates.mesh, columns(estimates), per)
