"""What an estimate comes to: quantities, what is undefined and why, strangers' functions."""

import warnings

import numpy as np
import pytest

import curvlib
from curvlib.claims.cell import NINE as PAPER
from curvlib.kit.compiled import compiled
from curvlib.kit.tensor import Curvatures, batch, from_form, put


@compiled
def saddle(ring):
    """All six, the same at every vertex."""
    m = ring.lengths.shape[1]
    found = batch(m)
    for k in range(m):
        put(found, k, from_form(-1.0, 0.0, 2.0, (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)))
    return found


def only_k1(ring):
    m = ring.lengths.shape[1]
    return Curvatures(None, None, np.ones(m), np.zeros(m), None, None)


@pytest.fixture
def sphere():
    return curvlib.tessellate(curvlib.surface("sphere"), 12)


def test_every_quantity_that_an_estimator_gives(sphere):
    r = curvlib.estimate(sphere, saddle)
    assert (r.K == -2).all()
    assert (r.H == 0.5).all()
    assert (r.k1 == 2).all()
    assert (r.k2 == -1).all()
    np.testing.assert_array_equal(np.abs(r.d1), np.tile([0, 1, 0], (len(r.K), 1)))
    np.testing.assert_array_equal(np.abs(r.d2), np.tile([1, 0, 0], (len(r.K), 1)))
    assert r.curvedness == pytest.approx(np.sqrt(2.5))
    assert r.shape_index == pytest.approx(2 / np.pi * np.arctan2(1, 3))


def test_what_an_estimator_does_not_give_is_nan_or_none(sphere):
    r = curvlib.estimate(sphere, only_k1)
    assert np.isnan(r.K).all()
    assert np.isnan(r.H).all()
    assert (r.k1 == 1).all()
    assert (r.k2 == 0).all()
    assert r.d1 is None
    assert r.d2 is None
    assert r.undefined == {}


def test_principal_values_of_an_estimator_of_K_and_H(sphere):
    r = curvlib.estimate(sphere, "taubin")
    assert r.d1 is None
    defined = np.isfinite(r.k1)
    np.testing.assert_array_equal(defined, (r.H**2 >= r.K * (1 - 1e-14)) & np.isfinite(r.K))
    assert (r.k1 >= r.k2)[defined].all()
    np.testing.assert_allclose((r.k1 * r.k2)[defined], r.K[defined], rtol=1e-12)
    K, H = r
    np.testing.assert_array_equal((K, H), (r.K, r.H))


def test_shape_index_and_curvedness_of_a_sphere(sphere):
    r = curvlib.estimate(sphere, lambda ring: (np.ones(ring.lengths.shape[1]),) * 2)
    assert (r.shape_index == 1).all()
    assert r.curvedness == pytest.approx(1)


def test_undefined_vertices_are_counted_by_cause():
    sphere = curvlib.tessellate(curvlib.surface("sphere"), 12)
    count = len(sphere.vertices)
    turned = sphere.faces.copy()
    turned[0] = turned[0][::-1]
    cylinder = curvlib.tessellate(curvlib.surface("cylinder"), 12)
    flat = sphere.vertices.copy()
    a, b, _ = sphere.faces[100]
    flat[a] = flat[b]
    lone = np.concatenate([sphere.vertices, [[5, 5, 5]]])
    for mesh, cause in (
        ((sphere.vertices, turned), "triangles that do not close to one ring"),
        (cylinder, "boundary"),
        ((lone, sphere.faces), "no triangle"),
    ):
        r = curvlib.estimate(mesh, "gauss_bonnet")
        assert r.undefined == {cause: np.isnan(r.K).sum()}
        assert 0 < r.undefined[cause] < count / 2
    r = curvlib.estimate((flat, sphere.faces), "gauss_bonnet")
    assert r.undefined.keys() == {"no finite value"}


def test_where_no_vertex_has_a_value_all_are_undefined(sphere):
    triangle = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
    for name in PAPER:
        with pytest.warns(curvlib.MeshWarning, match="3 of 3 vertices have no value"):
            assert curvlib.estimate(triangle, name).undefined == {"boundary": 3}
    assert curvlib.estimate(triangle, "quadric").undefined == {"no finite value": 3}
    none = curvlib.estimate(sphere, lambda ring: (None, None))
    assert none.undefined == {"no finite value": len(sphere.vertices)}


def test_points_of_a_soup_are_joined_and_that_is_said(sphere):
    """Values at all corners, those of the whole mesh; by cause where there is none."""
    points = np.vstack((sphere.vertices, [[5, 5, 5], [6, 5, 5], [5, 6, 5]]))
    whole = np.vstack((sphere.faces, [len(points) - k for k in (3, 2, 1)]))
    soup = points[whole].reshape(-1, 3), np.arange(whole.size).reshape(-1, 3)
    twice = sphere.faces.size - len(np.unique(sphere.faces))
    for name in ("gauss_bonnet", "quadric"):
        expected = curvlib.estimate((points, whole), name)
        joined = f"^{twice} of {whole.size} vertices stand where another one does: joined"
        with pytest.warns(curvlib.MeshWarning, match=joined) as w:
            found = curvlib.estimate(soup, name)
        assert w[0].filename == __file__
        np.testing.assert_allclose(found.K, expected.K[whole.reshape(-1)], rtol=1e-12)
        cause = "boundary" if name == "gauss_bonnet" else "no finite value"
        causes = {cause: np.isnan(expected.K)[whole].sum()}
        if expected.d1 is not None:
            umbilic = np.isnan(expected.d1[:, 0]) & ~np.isnan(expected.K)
            causes |= {"umbilic, without d1 and d2": umbilic[whole].sum()}
        assert found.undefined == {cause: n for cause, n in causes.items() if n}
    with pytest.warns(curvlib.MeshWarning, match="joined to it"):
        both = curvlib.estimate(soup, ["taubin", "quadric"])
    assert both["quadric"].d1.shape == (whole.size, 3)


def test_a_seam_is_told_though_few_vertices_lie_on_it(sphere):
    """Two halves of one sphere with a row of points each where they meet."""
    upper = sphere.vertices[sphere.faces].mean(1)[:, 2] > 0
    vertices = np.concatenate([sphere.vertices, sphere.vertices])
    faces = np.where(upper[:, None], sphere.faces, sphere.faces + len(sphere.vertices))
    used, faces = np.unique(faces, return_inverse=True)
    for name in ("taubin", "quadric"):
        with pytest.warns(curvlib.MeshWarning, match="^12 of 146 vertices stand where another"):
            curvlib.estimate((vertices[used], faces.reshape(-1, 3)), name)


def test_an_ordinary_boundary_is_no_matter_for_a_warning():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for name in ("taubin", "quadric"):
            curvlib.estimate(curvlib.tessellate(curvlib.surface("cylinder"), 12), name)


@pytest.mark.parametrize(
    ("function", "message"),
    [
        (lambda ring: None, "has to return K and H"),
        (lambda ring: (1, 2, 3), "has to return K and H"),
        (lambda rings: None, "unknown first parameter 'rings'; did you mean 'ring'"),
        (lambda ring, threads=1: None, "no option can be called 'threads'"),
        (lambda ring, x: None, "option 'x' has no default"),
        (lambda ring: Curvatures(*[None] * 4, ring.areas[0], None), r"as d1, expected \(3, "),
    ],
)
def test_functions_that_are_no_estimators(sphere, function, message):
    with pytest.raises(curvlib.InputError, match=message):
        curvlib.estimate(sphere, function)


def test_the_input_is_never_changed(sphere):
    vertices, faces = sphere.vertices.copy(), sphere.faces.copy()
    curvlib.estimate((vertices, faces), curvlib.estimators(), threads=2)
    np.testing.assert_array_equal(vertices, sphere.vertices)
    np.testing.assert_array_equal(faces, sphere.faces)


def test_hints_are_for_names_alone(sphere):
    with pytest.raises(curvlib.InputError, match=r"unknown estimator 3; valid: adaptive_fit"):
        curvlib.estimate(sphere, 3)
