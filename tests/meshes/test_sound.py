"""What is left out of a mesh: triangles at positions that are not finite, and repeated ones."""

import pickle

import numpy as np
import pytest

import curvlib
from curvlib.meshes.torus import torus

VERTICES, FACES = torus(12, "irregular")


def soup(faces):
    return VERTICES[faces].reshape(-1, 3), np.arange(faces.size).reshape(-1, 3)


@pytest.mark.filterwarnings("ignore::curvlib.MeshWarning")
@pytest.mark.parametrize("behind", [False, True])
@pytest.mark.parametrize("name", ["gauss_bonnet", "quadric"])
def test_a_mesh_with_every_triangle_twice(name, behind):
    """As in games, where a triangle for each side is drawn: values of the first ones."""
    expected = curvlib.estimate((VERTICES, FACES), name)
    both = np.vstack((FACES, FACES[:, ::-1] if behind else FACES))
    with pytest.warns(curvlib.MeshWarning, match="288 of 576 triangles are there again: left out"):
        found = curvlib.estimate((VERTICES, both), name)
    np.testing.assert_array_equal(found.K, expected.K)
    np.testing.assert_array_equal(found.H, expected.H)
    assert found.integral(found.K) == expected.integral(expected.K)
    with pytest.warns(curvlib.MeshWarning, match="1584 of 1728 vertices stand where another"):
        found = curvlib.estimate(soup(both), name)
    np.testing.assert_allclose(found.K, expected.K[both.reshape(-1)], rtol=1e-7, atol=1e-9)


def test_what_a_check_says_of_triangles_that_are_there_twice():
    for mesh in ((VERTICES, np.vstack((FACES, FACES[:, ::-1]))), soup(np.vstack((FACES, FACES)))):
        report = curvlib.check(curvlib.Mesh(*mesh))
        (fault,) = [x for x in report.faults if x.name == "triangles that are there again"]
        assert fault.where.tolist() == list(range(288, 576))
        assert "every one is there twice" in fault.remedy
    one = curvlib.check(curvlib.Mesh(VERTICES, np.vstack((FACES, FACES[[7], ::-1]))))
    assert [x.name for x in one.faults] == ["triangles that are there again"]
    assert "every one" not in one.faults[0].remedy
    assert (one.closed, one.genus) == (True, 1)


def test_two_sheets_of_one_outline_are_both_kept():
    """A pillow: the triangles stand at one place, but have corners of their own."""
    square = curvlib.Mesh(
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 0.2], [0.5, 0.5, -0.2]],
        [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]],
    )
    found = curvlib.estimate(square, "gauss_bonnet")
    assert found.undefined == {}
    twice = curvlib.tessellate(curvlib.surface("cone"), 6)
    sheets = (
        np.vstack((twice.vertices, twice.vertices)),
        np.vstack((twice.faces, twice.faces + len(twice.vertices))),
    )
    found, one = curvlib.estimate(sheets, "quadric"), curvlib.estimate(twice, "quadric")
    np.testing.assert_array_equal(found.K, np.tile(one.K, 2))


def test_a_hole_where_a_position_is_not_finite():
    """The neighbours of one of one-rings lack a value, too; a mesh of nothing else is an error."""
    vertices = VERTICES.copy()
    vertices[20, 1] = np.inf
    mesh = curvlib.Mesh(vertices, FACES)
    around = np.unique(FACES[(FACES == 20).any(1)])
    assert np.flatnonzero(mesh.concerned).tolist() == around.tolist()
    assert np.isinf(vertices[20, 1])
    for again in (mesh, pickle.loads(pickle.dumps(mesh)), curvlib.weld(mesh)[0]):
        with pytest.warns(curvlib.MeshWarning, match="1 of 144 vertices have a position that"):
            found = curvlib.estimate(again, "taubin")
        assert np.flatnonzero(np.isnan(found.K)).tolist() == around.tolist()
        assert found.undefined == {"position that is not finite": len(around)}
    with pytest.warns(curvlib.MeshWarning, match="and 6 triangles at them"):
        found = curvlib.estimate(mesh, "tensor_voting", per="face")
    assert found.undefined == {"position that is not finite": 6}
    with pytest.raises(curvlib.InputError, match=r"vertex 0 has .* so has one of each triangle"):
        curvlib.Mesh(np.full((4, 3), np.nan), FACES[:0:-1] % 4)


def test_an_estimator_of_the_mesh_is_given_what_is_left():
    """As peers are: other libraries have no words for what is left out."""
    vertices = np.vstack((VERTICES, [[np.nan, 0, 0]]))
    seen = []

    def mine(mesh):
        seen.append(mesh)
        return mesh.vertices[:, 0], None

    with pytest.warns(curvlib.MeshWarning):
        curvlib.estimate((vertices, np.vstack((FACES, FACES[:5], [[1, 2, 144]]))), mine)
    np.testing.assert_array_equal(seen[0].faces, FACES)
    assert np.isfinite(seen[0].vertices).all()
