"""Estimator `adaptive_fit`: what it chooses and how good that is; passes at some vertices."""

import re

import numpy as np
import pytest
from test_ball_regression import voxel_sphere

import curvlib
from curvlib.comparison.adaptive import fixed
from curvlib.estimators import ball_regression, compact_hermite, jet
from curvlib.kit.scales import forms
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
    passes, some = Passes(jittered("patch", 20, 1), 1), np.array([5, 200])
    np.testing.assert_array_equal(passes.field(forms, some), passes.field(forms)[:, some])


def test_a_field_that_is_solved_is_that_of_the_whole_mesh():
    mesh, some = jittered("torus", 20, 1), np.array([7, 300])
    found = Passes(mesh, 1).estimates(compact_hermite.estimate, some)
    expected = curvlib.estimate(mesh, "compact_hermite")
    np.testing.assert_array_equal(found["K"], expected.K[some])


def test_it_takes_no_option():
    with pytest.raises(curvlib.InputError):
        curvlib.estimate(jittered("patch", 10, 1), "adaptive_fit", rings=3)


@pytest.mark.parametrize("surface", ["torus", "ellipsoid", "patch"])
def test_exact_vertices_get_the_compact_scheme(surface):
    mesh = jittered(surface, 50, 2)
    found = curvlib.estimate(mesh, "adaptive_fit")
    expected = curvlib.estimate(mesh, "compact_hermite", degree=6)
    same = found.choice.index == found.choice.calls.index("compact_hermite(degree=6)")
    assert same.mean() > 0.9
    np.testing.assert_array_equal(found.K[same], expected.K[same])


@pytest.mark.parametrize(
    ("surface", "sigma"),
    [("ellipsoid", 1e-6), ("torus", 1e-4), ("patch", 1e-3), ("ellipsoid", 0.05), ("torus", 0.2)],
)
def test_errors_are_near_those_of_the_best_fixed_fit(surface, sigma):
    exact = jittered(surface, 40, 3)
    mesh, inner = noisy(exact, sigma), ~exact.boundary

    def error(name, **options):
        return np.abs(curvlib.estimate(mesh, name, **options).K - exact.K)[inner].mean()

    assert error("adaptive_fit") < 1.5 * min(error(name, **options) for name, options in fixed())


def test_each_half_of_a_mesh_has_its_own_fit():
    exact = jittered("ellipsoid", 60, 4)
    moves = noisy(exact, 0.05).vertices - exact.vertices
    half = exact.vertices[:, 0] > 0
    mesh = curvlib.Mesh(exact.vertices + moves * half[:, None], exact.faces)
    found = curvlib.estimate(mesh, "adaptive_fit")
    error = np.abs(found.K - exact.K)
    quiet, loud = exact.vertices[:, 0] < -0.6, exact.vertices[:, 0] > 0.1
    assert error[quiet].max() < 1e-3
    least = min(
        np.abs(curvlib.estimate(mesh, name, **options).K - exact.K)[loud].mean()
        for name, options in fixed()
    )
    assert error[loud].mean() < 1.5 * least
    exact_fit = found.choice.calls.index("compact_hermite(degree=6)")
    assert (found.choice.index[quiet] == exact_fit).mean() > 0.9
    assert not (found.choice.index[half] == exact_fit).any()


@pytest.mark.parametrize("surface", ["torus", "ellipsoid", "patch"])
def test_displaced_vertices_spoil_nothing(surface):
    exact, rng = jittered(surface, 50, 5), np.random.default_rng(5)
    far = rng.choice(2500, 12, replace=False)
    vertices = exact.vertices.copy()
    vertices[far] += 5 * exact.mean_edge * exact.normals[far] * rng.choice([-1, 1], (12, 1))
    clean = curvlib.estimate(curvlib.Mesh(exact.vertices, exact.faces), "adaptive_fit")
    found = curvlib.estimate(curvlib.Mesh(vertices, exact.faces), "adaptive_fit")
    scale = np.abs(exact.K).max()
    assert np.abs(found.K - exact.K)[~exact.boundary].max() < 0.1 * scale
    assert np.abs(found.K - clean.K).mean() < 1e-3 * scale


@pytest.mark.parametrize(("r", "off"), [(10, 0.01), (30, 0.03)])
def test_staircases_get_averaged_normals(r, off):
    mesh = voxel_sphere(r)
    found = curvlib.estimate(mesh, "adaptive_fit")
    assert all(call.startswith("ball_regression") for call in found.choice.calls)
    mean = np.linalg.norm(mesh.vertices, axis=1).mean()
    for k in (found.k1, found.k2, found.H):
        assert np.abs(k * mean - 1).mean() < off


def test_what_it_took_can_be_called():
    mesh = noisy(jittered("patch", 40, 6), 0.01)
    found = curvlib.estimate(mesh, "adaptive_fit")
    for k, call in enumerate(found.choice.calls):
        name, options = re.fullmatch(r"(\w+)\((.*)\)", call).groups()
        chosen = dict(eval(f"dict({options})"))
        at = found.choice.index == k
        np.testing.assert_array_equal(found.H[at], curvlib.estimate(mesh, name, **chosen).H[at])


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


@pytest.mark.parametrize("surface", ["torus", "ellipsoid"])
def test_coarse_meshes(surface):
    """Larger rings than the mesh has are no choice."""
    mesh = jittered(surface, 12, 1)
    error = np.abs(curvlib.estimate(mesh, "adaptive_fit").K - mesh.K).mean()
    assert error < 1.5 * np.abs(curvlib.estimate(mesh, "quadric").K - mesh.K).mean()
