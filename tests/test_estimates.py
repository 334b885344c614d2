"""What the result of an estimate can be turned into."""

import copy
import multiprocessing
import pickle
import re

import numpy as np
import pytest
import pyvista

import curvlib

MESH = curvlib.tessellate(curvlib.surface("ellipsoid"), 8)


def same(a, b):
    assert repr(a) == repr(b)
    assert a.undefined == b.undefined
    for name in ("K", "H", "k1", "k2", "d1", "d2", "shape_index", "curvedness"):
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name))


def test_copies_and_pickles():
    r = curvlib.estimate(MESH, "quadric")
    for other in (copy.copy(r), copy.deepcopy(r), pickle.loads(pickle.dumps(r))):
        same(other, r)
        assert not other.mesh.vertices.flags.writeable
    for mesh in (copy.copy(MESH), copy.deepcopy(MESH), pickle.loads(pickle.dumps(MESH))):
        same(curvlib.estimate(mesh, "quadric"), r)


def estimated(name):
    return curvlib.estimate(MESH, name)


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_other_processes(method):
    with multiprocessing.get_context(method).Pool(1) as pool:
        same(pool.map(estimated, ["meyer"])[0], estimated("meyer"))


def test_polydata_keeps_the_points_of_a_soup():
    soup = MESH.vertices[MESH.faces].reshape(-1, 3), np.arange(MESH.faces.size).reshape(-1, 3)
    with pytest.warns(curvlib.MeshWarning, match="joined"):
        r = curvlib.estimate(soup, "quadric")
    data = r.to_polydata()
    assert data.n_points == len(soup[0])
    np.testing.assert_array_equal(data.regular_faces, soup[1])
    np.testing.assert_array_equal(data["K"], r.K)
    assert np.isfinite(data["K"]).all()
    data.points[:] = 0
    data["K"][:] = 0
    assert r.mesh.vertices.any()
    assert r.K.all()


def test_dataframe():
    r = curvlib.estimate(MESH, "gauss_bonnet")
    table = r.to_dataframe()
    assert list(table) == ["K", "H", "k1", "k2", "shape_index", "curvedness"]
    np.testing.assert_array_equal(table.K, r.K)


def test_an_estimator_of_K_alone_has_no_empty_columns():
    def K_alone(ring):
        return ring.lengths.sum(0), None

    assert list(curvlib.estimate(MESH, K_alone).to_dataframe()) == ["K"]


def test_notebooks_show_quantiles_and_causes():
    r = curvlib.estimate(curvlib.tessellate(curvlib.surface("cylinder"), 8), "gauss_bonnet")
    html = r._repr_html_()
    assert "16 boundary" in html
    assert len(re.findall("<tr>", html)) == 7
    assert html.count("<") == html.count(">")


def test_the_recommended_estimator():
    same(curvlib.estimate(MESH), curvlib.estimate(MESH, "adaptive_fit"))
    same(curvlib.estimate(MESH, rings=3), curvlib.estimate(MESH, "quadric", rings=3))
    per_face = curvlib.estimate(MESH, per="face")
    same(per_face, curvlib.estimate(MESH, "tensor_voting", per="face"))
    with pytest.raises(curvlib.InputError, match="did you mean 'face'"):
        curvlib.estimate(MESH, per="fase")


def test_the_accessor_of_pyvista():
    import curvlib.accessor

    ball = pyvista.Icosphere(radius=2, nsub=2)
    names = set(ball.point_data.keys())
    data = ball.curvlib.estimate("jet", degree=3)
    np.testing.assert_array_equal(data["H"], curvlib.estimate(ball, "jet", degree=3).H)
    assert set(ball.point_data.keys()) == names
    assert "K" in ball.curvlib.estimate(per="face").cell_data
    with pytest.raises(curvlib.InputError, match="triangulate"):
        pyvista.Plane().curvlib.estimate()
