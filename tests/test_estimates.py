"""What the result of an estimate can be turned into."""

import copy
import multiprocessing
import pickle
import re

import numpy as np
import pytest
import pyvista

import curvlib
from curvlib.columns import CATEGORIES
from curvlib.estimates import Estimates
from curvlib.meshes.torus import torus

MESH = curvlib.tessellate(curvlib.surface("ellipsoid"), 8)


def same(a, b):
    assert repr(a) == repr(b)
    assert a.undefined == b.undefined
    for name in ("K", "H", "k1", "k2", "d1", "d2", "shape_index", "curvedness", "category"):
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
    derived = ["shape_index", "curvedness", "category", "bending_energy"]
    assert list(table) == ["K", "H", "k1", "k2", *derived]
    np.testing.assert_array_equal(table.K, r.K)


def test_an_estimator_of_K_alone_has_no_empty_columns():
    def K_alone(ring):
        return ring.lengths.sum(0), None

    assert list(curvlib.estimate(MESH, K_alone).to_dataframe()) == ["K"]


def test_notebooks_show_quantiles_and_causes():
    r = curvlib.estimate(curvlib.tessellate(curvlib.surface("cylinder"), 8), "gauss_bonnet")
    html = r._repr_html_()
    assert "16 boundary" in html
    rows = re.findall("<tr><th>(.*?)</th>", html)
    names = ["K", "H", "k1", "k2", "shape_index", "curvedness", "bending_energy"]
    assert rows == ["over the area", *names]
    assert "Shape by area: ridge 100%" in html
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


def principal(k1, k2):
    """Estimates of these principal curvatures at every vertex."""
    k = np.full((2, len(MESH.vertices)), [[k1], [k2]])
    return Estimates(MESH, {"K": k[0] * k[1], "H": k.mean(0), "k1": k[0], "k2": k[1]}, "mesh")


@pytest.mark.parametrize(
    ("k1", "k2", "name"),
    [
        (1, 1, "cap"),
        (2, 1, "dome"),
        (1, 0, "ridge"),
        (1, -0.4, "saddle ridge"),
        (1, -1, "saddle"),
        (0.4, -1, "saddle rut"),
        (0, -1, "rut"),
        (-1, -2, "trough"),
        (-1, -1, "cup"),
        (0, 0, "flat"),
        (1e-4, -1e-4, "flat"),
        (np.nan, np.nan, None),
    ],
)
def test_categories_of_the_shape_index(k1, k2, name):
    """The shapes amid the nine categories, and a plane."""
    code = principal(k1, k2).category
    if name is None:
        assert np.isnan(code).all()
    else:
        assert {CATEGORIES[int(x)] for x in code} == {name}


def test_categories_meet_at_odd_eighths():
    """As Koenderink and van Doorn (1992) divide the shape index."""
    for number, limit in enumerate(np.arange(-7, 8, 2) / 8):
        for index, code in ((limit - 1e-9, number), (limit + 1e-9, number + 1)):
            angle = index * np.pi / 2
            r = principal(np.sin(angle) + np.cos(angle), np.sin(angle) - np.cos(angle))
            np.testing.assert_allclose(r.shape_index, index, atol=1e-12)
            assert (r.category == code).all()


def test_bending_energy():
    """8 pi of any sphere, 4 pi^2 of Clifford's torus; none where H is half of c0."""
    ball = pyvista.Icosphere(radius=3, nsub=4)
    r = curvlib.estimate(ball, "compact_hermite")
    assert r.integral(r.bending_energy()) == pytest.approx(8 * np.pi, rel=2e-3)
    assert r.integral(r.bending_energy(2 / 3)) < 1e-4
    assert r.integral(r.bending_energy(-2 / 3)) == pytest.approx(32 * np.pi, rel=2e-3)
    r = curvlib.estimate(torus(60, "irregular", radii=(np.sqrt(2), 1)), "compact_hermite")
    assert r.integral(r.bending_energy()) == pytest.approx(4 * np.pi**2, rel=1e-2)
    np.testing.assert_array_equal(r.to_dataframe().bending_energy, 2 * r.H**2)


def test_integrals_leave_out_what_is_undefined():
    K = np.where(MESH.vertices[:, 2] > 0, 1.0, np.nan)
    r = Estimates(MESH, {"K": K}, "mesh")
    corners = np.isfinite(K)[MESH.faces].sum(1)
    areas = pyvista.PolyData.from_regular_faces(MESH.vertices, MESH.faces).compute_cell_sizes()
    assert r.integral(r.K) == pytest.approx((areas["Area"] * corners).sum() / 3)
    assert np.isnan(r.integral(r.H))


def test_standard_errors_are_columns():
    ones = np.ones(len(MESH.vertices))
    r = Estimates(MESH, {"K": ones, "H": ones, "K_error": 2 * ones, "k1_error": 3 * ones}, "mesh")
    assert r.returned == ("K", "H")
    table = r.to_dataframe()
    assert list(table)[-2:] == ["K_error", "k1_error"]
    assert (table.K_error == 2).all()
    assert curvlib.estimate(MESH, "meyer").K_error is None
