"""A mesh keeps what it checked, and says in one line what it does not take."""

import pickle
from copy import deepcopy

import numpy as np
import pytest

import curvlib
from curvlib.meshes.torus import torus

TRIANGLE = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0.0]])


def test_later_changes_of_the_callers_arrays_are_not_seen():
    vertices, faces = torus(8, "regular")
    mesh = curvlib.Mesh(vertices, faces)
    before = curvlib.estimate(mesh, "gauss_bonnet")
    vertices[3] = np.nan
    faces[:] = faces[:, ::-1]
    fresh = curvlib.Mesh(mesh.vertices, mesh.faces)
    for m in (mesh, fresh):
        np.testing.assert_array_equal([*curvlib.estimate(m, "gauss_bonnet")], [*before])


def test_arrays_of_a_mesh_are_read_only_and_the_callers_stay_writeable():
    vertices, faces = torus(8, "regular")
    normals = np.tile([0, 0, 1.0], (len(vertices), 1))
    mesh = curvlib.Mesh(vertices, faces, copy=False, normals=normals)
    for array in (mesh.vertices, mesh.faces, mesh.normals):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0
    for name in ("vertices", "faces"):
        with pytest.raises(AttributeError):
            setattr(mesh, name, None)
    assert vertices.flags.writeable
    assert faces.flags.writeable
    assert normals.flags.writeable
    assert np.shares_memory(mesh.vertices, vertices)
    assert not np.shares_memory(curvlib.Mesh(vertices, faces).vertices, vertices)


@pytest.mark.parametrize(
    ("vertices", "faces", "message"),
    [
        ([[0, 0, 0], [1, 0]], [[0, 1, 2]], "vertices: not an array of numbers"),
        (TRIANGLE, [[0, 1, 2], [0, 1]], "faces: not an array of numbers"),
        (TRIANGLE.astype(str), [[0, 1, 2]], "vertices: an array of numbers is expected, not <U"),
        (TRIANGLE + 1j, [[0, 1, 2]], "vertices: .* not complex128"),
        ({"x": 1}, [[0, 1, 2]], "vertices: .* not object"),
        (TRIANGLE > 0, [[0, 1, 2]], "vertices: .* not bool"),
        (TRIANGLE, [[0.0, 1.0, 2.0]], "faces: an array of integers is expected, not float64"),
        (TRIANGLE, [["0", "1", "2"]], "faces: .* not <U1"),
        (TRIANGLE, [[0, 1, -1]], r"face 0 is \[0, 1, -1\]"),
        (TRIANGLE, np.array([[0, 1, 2**63]], dtype=np.uint64), "face 0 is"),
        (np.where(TRIANGLE == 1, np.inf, 0), [[0, 1, 2]], "vertex 1 has a coordinate that is not"),
    ],
)
def test_what_is_no_mesh(vertices, faces, message):
    with pytest.raises(curvlib.InputError, match=message):
        curvlib.Mesh(vertices, faces)


@pytest.mark.parametrize(
    ("field", "message"),
    [
        ({"K": ["a", "b", "c"]}, "K: an array of numbers is expected"),
        ({"H": [1, 2]}, r"H: shape \(2,\), expected \(3,\)"),
        ({"smooth": [0, 1, 1]}, "smooth: an array of bool is expected, not int64"),
        ({"pole": [[True], [True, False]]}, "pole: not an array of numbers"),
        ({"normal": TRIANGLE}, "unknown field 'normal'; did you mean 'normals'"),
        ({"normals": [[0, 0, 1], [0, 0], [0, 0, 1]]}, "normals: not an array of numbers"),
    ],
)
def test_fields_are_checked(field, message):
    with pytest.raises(curvlib.InputError, match=message):
        curvlib.Mesh(TRIANGLE, [[0, 1, 2]], **field)


def test_a_mesh_from_another_process_is_read_only_as_well():
    mesh = curvlib.Mesh(TRIANGLE, [[0, 1, 2]], normals=TRIANGLE + 1, pole=[True, False, False])
    for copy in (pickle.loads(pickle.dumps(mesh)), deepcopy(mesh)):
        for name in ("vertices", "faces", "normals", "pole"):
            np.testing.assert_array_equal(getattr(copy, name), getattr(mesh, name))
            assert not getattr(copy, name).flags.writeable


def test_more_vertices_than_32_bits_count(monkeypatch):
    monkeypatch.setattr("curvlib.meshes.mesh.MOST_VERTICES", 4)
    curvlib.Mesh(TRIANGLE, [[0, 1, 2]])
    with pytest.raises(curvlib.InputError, match="more than 4 vertices or corners"):
        curvlib.Mesh(TRIANGLE, [[0, 1, 2], [0, 2, 1]])


@pytest.mark.parametrize("name", ["paraboloid", "circular", "watanabe_b", "taubin"])
def test_a_normal_is_a_direction(name):
    """Twice as long, as float32, or of length zero: right, the same to float32, and NaN."""
    m = curvlib.tessellate(curvlib.surface("ellipsoid"), 12)
    right = curvlib.estimate(m, name, normal="exact")

    def found(normals):
        return curvlib.estimate(curvlib.Mesh(m.vertices, m.faces, normals=normals), name,
                                normal="exact")  # fmt: skip

    np.testing.assert_allclose([*found(2 * m.normals)], [*right], rtol=1e-12)
    np.testing.assert_allclose([*found(np.float32(m.normals))], [*right], rtol=1e-4)
    one = np.where(np.arange(len(m.vertices))[:, None] == 7, 0, m.normals)
    assert np.flatnonzero(np.isnan(found(one).H)).tolist() == [7]


def test_unit_normals_are_left_as_they_are():
    m = curvlib.tessellate(curvlib.surface("teapot_spout"), 8)
    again = curvlib.Mesh(m.vertices, m.faces, normals=m.normals)
    np.testing.assert_array_equal(again.normals, m.normals)


def test_faces_that_name_a_vertex_twice_make_no_boundary():
    m = curvlib.tessellate(curvlib.surface("sphere"), 8)
    a, b, _ = m.faces[::5].T
    faces = np.concatenate([m.faces, np.column_stack([a, b, b])])
    assert not curvlib.Mesh(m.vertices, faces).boundary.any()


def unit_of(vertices):
    return curvlib.Mesh(vertices, np.empty((0, 3), int)).unit


def test_units_are_powers_of_two():
    """Exact, and one for whatever float32 can hold."""
    for largest in (0.0, 1e-38, 1.0, 3e38):
        assert unit_of(np.array([[-largest, 0, 0]])) == 1
    for largest in (5e-324, 1e-300, 1e-150, 1e150, 1.7e308):
        factor = unit_of(np.array([[0, largest, 0], [0, -largest / 2, 0]]))
        assert np.frexp(factor)[0] == 0.5
        assert largest == 5e-324 or 0.25 <= largest * factor <= 1
    assert unit_of(np.empty((0, 3))) == 1
