"""Meshes from files of every format that can be written here."""

import warnings

import numpy as np
import pytest
import pyvista
import trimesh

import curvlib
from curvlib.meshes.reading import SUFFIXES
from curvlib.meshes.torus import torus

VERTICES, FACES = torus(12, "irregular")


@pytest.fixture(scope="module")
def expected():
    return curvlib.estimate((VERTICES, FACES), "gauss_bonnet").K


def written(path):
    if SUFFIXES[path.suffix] == "trimesh":
        trimesh.Trimesh(VERTICES, FACES, process=False).export(path)
    else:
        pyvista.PolyData.from_regular_faces(VERTICES, FACES).save(path)
    return path


@pytest.mark.parametrize("suffix", [".ply", ".obj", ".stl", ".off", ".glb", ".vtp", ".vtk"])
def test_formats(tmp_path, suffix, expected):
    """The same triangles, with values at all points, joined where the format splits them."""
    path = written(tmp_path / f"torus{suffix}")
    mesh = curvlib.read(path)
    assert len(mesh.faces) == len(FACES)
    np.testing.assert_allclose(mesh.vertices[mesh.faces], VERTICES[FACES], atol=1e-6)
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        found = curvlib.estimate(str(path), "gauss_bonnet").K
    assert len(heard) == (suffix == ".stl")
    np.testing.assert_allclose(found[mesh.faces], expected[FACES], atol=1e-2)


def test_names_are_told_apart_by_their_case_alone(tmp_path):
    path = written(tmp_path / "torus.ply")
    path = path.rename(tmp_path / "torus.PLY")
    assert len(curvlib.read(path).vertices) == len(VERTICES)


def test_normals_of_a_file(tmp_path):
    mesh = pyvista.PolyData.from_regular_faces(VERTICES, FACES)
    mesh = mesh.compute_normals(split_vertices=False, cell_normals=False, consistent_normals=False)
    for suffix in (".ply", ".vtp"):
        path = tmp_path / f"normals{suffix}"
        mesh.save(path)
        np.testing.assert_allclose(
            curvlib.read(path).normals, mesh.point_data["Normals"], atol=1e-6
        )
    assert curvlib.read(written(tmp_path / "plain.ply")).normals is None


def test_quads_lines_and_volumes(tmp_path):
    off = tmp_path / "quad.off"
    off.write_text("OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n")
    assert len(curvlib.read(off).faces) == 2
    mesh = pyvista.PolyData.from_regular_faces(VERTICES, FACES)
    mesh.lines = np.array([2, 0, 1])
    mesh.save(tmp_path / "line.vtp")
    assert len(curvlib.read(tmp_path / "line.vtp").faces) == len(FACES)
    grid = pyvista.ImageData(dimensions=(4, 4, 4)).cast_to_unstructured_grid()
    grid.save(tmp_path / "boxes.vtu")
    boxes = curvlib.read(tmp_path / "boxes.vtu")
    assert len(boxes.vertices) == 64
    np.testing.assert_array_equal(boxes.vertices, grid.points)
    assert len(boxes.faces) == 6 * 9 * 2
    assert curvlib.check(boxes).closed


@pytest.mark.parametrize("suffix", [".ply", ".obj", ".stl", ".off", ".glb", ".vtp", ".vtk"])
@pytest.mark.parametrize("content", [b"", b"\x00\xff" * 50, b"solid\nfacet normal x\n"])
def test_what_is_no_mesh(tmp_path, suffix, content):
    path = tmp_path / f"broken{suffix}"
    path.write_bytes(content)
    with pytest.raises(curvlib.InputError, match=rf"broken\{suffix}.*(cannot read|no triangles)"):
        curvlib.read(path)


def test_files_that_are_not_there_or_not_known(tmp_path):
    written(tmp_path / "scan.ply")
    with pytest.raises(curvlib.InputError, match=r"no such file; did you mean .*scan\.ply"):
        curvlib.read(tmp_path / "scam.ply")
    with pytest.raises(curvlib.InputError, match=r"no such file$"):
        curvlib.read(tmp_path / "nowhere" / "a.ply")
    (tmp_path / "scan.step").write_text("x")
    with pytest.raises(curvlib.InputError, match=r"by its suffix; known: \.3mf, \.gii"):
        curvlib.read(tmp_path / "scan.step")
    (tmp_path / "cloud.ply").write_text(
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
        "property float z\nend_header\n0 0 0\n"
    )
    with pytest.raises(curvlib.InputError, match="no triangles"):
        curvlib.estimate(tmp_path / "cloud.ply", "taubin")
