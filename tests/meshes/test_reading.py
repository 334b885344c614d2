"""Meshes from files of every format that can be written here."""

import time
import warnings

import numpy as np
import pytest
import pyvista
import trimesh

import curvlib
from curvlib.meshes.torus import torus

VERTICES, FACES = torus(12, "irregular")


@pytest.fixture(scope="module")
def expected():
    return curvlib.estimate((VERTICES, FACES), "gauss_bonnet").K


def written(path):
    if path.suffix not in (".vtp", ".vtk"):
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


# One quad and one triangle, whose corners have textures and normals of their own.
OBJ = """# comment
v 0 0 0 1 1 1
v\t1 0 0
v 1 1 0
v 0 1 \\
0
vt 0 0
vn 0 0 2
vn 1 0 0
g part
f 1/1/1 2/1/1 3/1/1 4/1/1
v 0 0 1
vt 1 1
f -5/-1/-1 2/2/2 -1/2/2
l 1 2
"""


def test_points_of_an_obj_are_those_of_the_file(tmp_path):
    path = tmp_path / "quad.obj"
    path.write_text(OBJ)
    mesh = curvlib.read(path)
    np.testing.assert_array_equal(
        mesh.vertices, [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1]]
    )
    np.testing.assert_array_equal(mesh.faces, [[0, 1, 2], [0, 2, 3], [0, 1, 4]])
    r = np.sqrt(0.5)
    expected = [[2 / np.sqrt(5), 0, 1 / np.sqrt(5)], [r, 0, r], [0, 0, 1], [0, 0, 1], [1, 0, 0]]
    # Normals of files have any length: the second vertex has (0, 0, 2) and (1, 0, 0).
    expected[0] = expected[1] = [1 / np.sqrt(5), 0, 2 / np.sqrt(5)]
    np.testing.assert_allclose(mesh.normals, expected, atol=1e-15)


@pytest.mark.parametrize("form", ["ascii", "binary_little_endian", "binary_big_endian"])
@pytest.mark.parametrize("mixed", [False, True])
def test_ply_of_any_layout(tmp_path, form, mixed):
    """Elements before, between and behind; lists of several sizes; properties of any type."""
    polygons = [[0, 1, 2, 3], [0, 1, 4], [4, 3, 0]] if mixed else [[0, 1, 2], [0, 1, 4]]
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 0.5]])
    order = ">" if "big" in form else "<"
    words, body = [], b""

    def put(kind, *numbers):
        nonlocal body
        words.extend(map(str, numbers))
        body += np.array(numbers, order + kind).tobytes()

    for camera in (1.5, 2.5):
        put("f8", camera)
    for k, point in enumerate(points):
        put("u1", k)
        put("f4", *point)
        put("i4", 2)
        put("i2", -k, k)
    for polygon in polygons:
        put("u1", len(polygon))
        put("u4", *polygon)
        put("f4", 0.25)
    put("i1", 7)
    header = (
        f"ply\nformat {form} 1.0\ncomment made\nelement camera 2\nproperty double view\n"
        "element vertex 5\nproperty uchar red\nproperty float x\nproperty float y\n"
        "property float z\nproperty list int short ends\n"
        f"element face {len(polygons)}\nproperty list uchar uint vertex_indices\n"
        "property float quality\nelement last 1\nproperty char x\nend_header\n"
    )
    path = tmp_path / "layout.ply"
    path.write_bytes(header.encode() + (" ".join(words).encode() if form == "ascii" else body))
    mesh = curvlib.read(path)
    np.testing.assert_array_equal(mesh.vertices, points)
    fans = [[0, 1, 2], [0, 2, 3], [0, 1, 4], [4, 3, 0]] if mixed else polygons
    np.testing.assert_array_equal(mesh.faces, fans)


def test_strips_of_a_ply(tmp_path):
    """Two strips in one list and one of two triangles, which agree over their edges."""
    path = tmp_path / "strips.ply"
    path.write_text(
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
        "property float z\nelement tristrips 2\nproperty list int int vertex_indices\n"
        "end_header\n0 0 0 1 0 0 0 1 0 1 1 0 0 2 0 1 2 0\n10 0 1 2 3 4 -1 0 1 5 -1\n4 5 4 3 2\n"
    )
    mesh = curvlib.read(path)
    expected = [[0, 1, 2], [2, 1, 3], [2, 3, 4], [0, 1, 5], [5, 4, 3], [3, 4, 2]]
    assert mesh.faces.tolist() == expected


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.obj", "v 0 0 0\nv 1 x 0\nf 1 2 1\n", r"v '1 x 0' is not 3 numbers"),
        ("a.obj", "v 0 0 0\nv 1 0\nf 1 2 1\n", r"v '1 0' is not 3 numbers"),
        ("a.obj", "v 0 0 0\nf 1 1 2\n", r"a face names 2, but indices run from 1 to 1"),
        ("a.obj", "v 0 0 0\nf 1 1 a\n", r"'a' is no index"),
        ("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", r"cut off: 2 lines for 3 vertices and 1 faces"),
        ("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0\n", r"a face is '3 0 0', which is no number and"),
        ("a.off", "OFF\n1 1 0\n0 0 0\n3 0 0 9\n", r"face 0 is \[0, 0, 9\], but"),
        ("a.stl", "solid x\nvertex 0 0 0\nvertex 1 0 0\n", r"cut off: 2 corners make no whole"),
        ("a.stl", "\0" * 83 + "\1", r"cut off: 0 triangles, of 16777216"),
        ("a.ply", "ply\nformat ascii 1.0\n", r"its header is missing or cut off"),
        (
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 999999999999\nproperty flat x\nend_header\n",
            "unknown type 'flat'; did you mean 'float'",
        ),
        (
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 999999999999\nproperty float x\nend_header\n1",
            "cut off: 999999999999 of vertex are not all there",
        ),
        ("a.obj", "ply\nformat ascii 1.0\n", r"no triangles in it; it begins as a \.ply file does"),
        ("a.vtk", "# vtk DataFile Version 5.1\nx\nASCII\nDATASET POLYDATA\n", "no triangles"),
        ("a.vtp", "<VTKFile", "pyvista cannot read it"),
    ],
)
def test_what_is_wrong_in_a_file_is_told(tmp_path, name, text, message):
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(curvlib.InputError, match=message) as caught:
        curvlib.read(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)
    with pytest.raises(curvlib.InputError, match="is a folder; name a file in it"):
        curvlib.read(tmp_path)


@pytest.mark.parametrize("offsets", ["0 300000000", "-9000000 3"])
def test_a_file_that_ends_the_reader(tmp_path, capfd, offsets):
    """VTK reads memory that is not its own: that is one error, without noise."""
    path = tmp_path / "a.vtk"
    text = (
        "# vtk DataFile Version 5.1\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n"
        "0 0 0 1 0 0 0 1 0\nCELLS 2 3\nOFFSETS vtktypeint64\n{}\n"
        "CONNECTIVITY vtktypeint64\n0 1 2\nCELL_TYPES 1\n5\n"
    )
    path.write_text(text.format("0 3"))
    assert curvlib.read(path).faces.tolist() == [[0, 1, 2]]
    path.write_text(text.format(offsets))
    with pytest.raises(curvlib.InputError, match=r"a\.vtk': pyvista cannot read it: .*broken"):
        curvlib.read(path)
    assert capfd.readouterr() == ("", "")


def test_a_reader_that_hangs(tmp_path, monkeypatch):
    """It is stopped; a larger file has more time."""
    (tmp_path / "pyvista.py").write_text("import time\n\ntime.sleep(600)\n")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr("curvlib.meshes.reading.SECONDS", 0.5)
    monkeypatch.setattr("curvlib.meshes.reading.BYTES_A_SECOND", 20)
    path = tmp_path / "a.vtk"
    path.write_text("# vtk DataFile ")
    start = time.monotonic()
    with pytest.raises(curvlib.InputError, match=r"a\.vtk': pyvista .*did not end within 1 s, and"):
        curvlib.read(path)
    assert 1 < time.monotonic() - start < 60
