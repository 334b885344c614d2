"""Estimator `adaptive_fit`: what it chooses and how good that is; passes at some vertices."""

import numpy as np
import pytest
from test_ball_regression import voxel_sphere

import curvlib
from curvlib.estimators import adaptive_fit, ball_regression, jet
from curvlib.meshes.jittered import jittered
from curvlib.passes import Passes


def noisy(mesh, sigma, seed=5):
    """The mesh with normal noise of sigma mean edges."""
    moves = np.random.default_rng(seed).standard_normal((len(mesh.vertices), 1))
    moves *= sigma * mesh.mean_edge
    return curvlib.Mesh(mesh.vertices + moves * mesh.normals, mesh.faces)


@pytest.mark.parametrize(
    ("function", "options"),
    [(jet.estimate, {"degree": 4, "rings": 3}), (ball_regression.estimate, {"radius": "3 edges"})],
)
def test_values_at_some_vertices_are_those_at_all(function, options):
    """Fields included, which are computed only where they are read."""
    mesh = jittered("torus", 30, 1)
    passes, some = Passes(mesh, 2), np.array([700, 3, 4, 250])
    found, every = (
        passes.estimates(function, some, **options),
        passes.estimates(function, **options),
    )
    assert set(found) == {"K", "H", "k1", "k2", "d1", "d2"}
    for name, values in found.items():
        np.testing.assert_array_equal(values, every[name][..., some])


def test_a_field_at_some_vertices():
    mesh = jittered("patch", 20, 1)
    passes = Passes(mesh, 1)
    some = np.array([5, 200])
    every = passes.field(adaptive_fit.clean)
    np.testing.assert_array_equal(passes.field(adaptive_fit.clean, some), every[:, some])


def test_it_takes_no_option():
    with pytest.raises(curvlib.InputError):
        curvlib.estimate(jittered("patch", 10, 1), "adaptive_fit", rings=3)


@pytest.mark.parametrize("surface", ["torus", "ellipsoid", "patch"])
def test_exact_vertices_get_degree_6(surface):
    mesh = jittered(surface, 40, 2)
    found = curvlib.estimate(mesh, "adaptive_fit")
    assert found.choice.calls == ("jet(degree=6, rings=3)",)
    assert (found.choice.index == 0).all()
    expected = curvlib.estimate(mesh, "jet", degree=6, rings=3)
    np.testing.assert_array_equal(found.K, expected.K)


@pytest.mark.parametrize("sigma", [1e-3, 0.05])
def test_scale_grows_with_noise_and_errors_are_near_the_best(sigma):
    exact = jittered("ellipsoid", 40, 3)
    mesh = noisy(exact, sigma)
    found = curvlib.estimate(mesh, "adaptive_fit")
    assert found.choice.calls != ("jet(degree=6, rings=3)",)
    passes = Passes(mesh, 1)
    fixed = [
        passes.estimates(adaptive_fit.polynomial, degree=degree, rings=rings)["K"]
        for degree, scales in adaptive_fit.RINGS.items()
        for rings in scales[:-1]
    ]
    errors = [np.abs(K - exact.K).mean() for K in fixed]
    assert np.abs(found.K - exact.K).mean() < 1.6 * min(errors)


def test_staircases_get_averaged_normals():
    mesh = voxel_sphere(10)
    found = curvlib.estimate(mesh, "adaptive_fit")
    assert found.choice.calls[0].startswith("ball_regression")
    mean = np.linalg.norm(mesh.vertices, axis=1).mean()
    assert np.abs(found.H * mean - 1).mean() < 0.05


def test_threads_change_no_byte():
    mesh = noisy(jittered("torus", 50, 4), 0.01)
    one, two = (curvlib.estimate(mesh, "adaptive_fit", threads=t) for t in (1, 2))
    assert one.choice.calls == two.choice.calls
    for name in ("K", "H", "k1", "k2", "d1", "d2"):
        np.testing.assert_array_equal(getattr(one, name), getattr(two, name))


@pytest.mark.filterwarnings("ignore::curvlib.MeshWarning")
def test_a_mesh_without_disks_has_no_values():
    mesh = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.empty((0, 3), int)
    assert np.isnan(curvlib.estimate(mesh, "adaptive_fit").K).all()
