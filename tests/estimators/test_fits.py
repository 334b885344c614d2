"""Fits of polynomials to disks: against other programs, their order, where they are exact."""

from pathlib import Path
from typing import Literal

import numpy as np
import pytest

import curvlib
from curvlib.comparison.references import principal_axes
from curvlib.kit.polynomial import fit_polynomial
from curvlib.kit.tensor import from_graph
from curvlib.meshes.jittered import graph, wavy
from curvlib.meshes.torus import torus

PEERS = np.load(Path(__file__).with_name("peers.npz"))


def peers(name):
    return curvlib.Mesh(PEERS[f"{name}_vertices"], PEERS[f"{name}_faces"])


@pytest.mark.parametrize("name", ["torus", "patch"])
@pytest.mark.parametrize(("degree", "rings"), [(2, 2), (4, 3)])
def test_jets_against_cgal(name, degree, rings):
    """CGAL 5.5.1, Monge_via_jet_fitting over the vertex and its rings, NaN with too few points: the
    same in its frame; in ours within the error of the method, and no worse in the mean."""
    mesh, theirs = peers(name), PEERS[f"{name}_jet_degree{degree}_rings{rings}"]
    same = curvlib.estimate(mesh, principal_axes, degree=degree, rings=rings)
    there = np.isfinite(theirs[:, 0])
    np.testing.assert_allclose(same.k1[there], theirs[there, 0], atol=1e-9)
    np.testing.assert_allclose(same.k2[there], theirs[there, 1], atol=1e-9)
    parallel = np.abs((same.d1 * theirs[:, 2:]).sum(1))
    np.testing.assert_allclose(parallel[there], 1, atol=1e-9)
    ours = curvlib.estimate(mesh, "jet", degree=degree, rings=rings, fit="approximation")
    difference = np.abs(ours.k1 - theirs[:, 0])[there & ~mesh.boundary]
    assert 1e-6 < difference.mean() < (0.02 if degree == 2 else 0.01)
    assert np.isfinite(ours.K).all()


@pytest.mark.parametrize("name", ["torus", "patch"])
def test_quadrics_against_libigl(name):
    """Libigl 2.6.3, principal_curvature(V, F, 2): the trace of its form is that of ours, and k1 is
    within the square of the slope, which its symmetrised form neglects."""
    ours, theirs = curvlib.estimate(peers(name), "quadric"), PEERS[f"{name}_libigl"]
    np.testing.assert_allclose(ours.H, theirs.sum(1) / 2, atol=1e-12)
    inner = ~peers(name).boundary
    assert np.abs(ours.k1 - theirs[:, 0])[inner].max() < 0.02


def exact(x, y, f):
    """K and H of a graph, by central differences."""
    h = 1e-4
    p, q = ((f(x + dx, y + dy) - f(x - dx, y - dy)) / (2 * h) for dx, dy in ((h, 0), (0, h)))
    r = (f(x + h, y) - 2 * f(x, y) + f(x - h, y)) / h**2
    t = (f(x, y + h) - 2 * f(x, y) + f(x, y - h)) / h**2
    s = (f(x + h, y + h) - f(x - h, y + h) - f(x + h, y - h) + f(x - h, y - h)) / (4 * h * h)
    g = 1 + p * p + q * q
    H = -((1 + q * q) * r - 2 * p * q * s + (1 + p * p) * t) / (2 * g**1.5)
    return (r * t - s * s) / g**2, H


@pytest.mark.parametrize(
    ("name", "options", "order"),
    [
        ("quadric", {}, 1),
        ("quadric", {"rings": 3}, 1),
        ("quadric", {"radius": "2.5 edges"}, 1),
        ("jet", {}, 1),
        ("jet", {"degree": 3}, 2),
        ("jet", {"degree": 4, "rings": 3}, 3),
        ("jet", {"degree": 5, "rings": 3}, 4),
        ("jet", {"degree": 6, "rings": 4}, 5),
        ("jet", {"degree": 6, "rings": 3}, 5),
        ("jet", {"degree": 4, "radius": "3.5 edges"}, 3),
        ("jet", {"degree": 4, "rings": 3, "fit": "approximation"}, 3),
    ],
)
def test_order_on_irregular_meshes(name, options, order):
    """Of K and H in the mean over interior vertices; at the boundary of the median, since corners
    have a jet of lower degree."""
    errors = []
    for n in (33, 65):
        mesh = graph(n, wavy)
        found = curvlib.estimate(mesh, name, **options)
        x, y, _ = mesh.vertices.T
        K, H = exact(x, y, wavy)
        assert np.isfinite(found.K).all()
        off = [np.abs(found.K - K), np.abs(found.H - H)]
        errors.append(
            [
                f(e[part])
                for e in off
                for f, part in ((np.mean, ~mesh.boundary), (np.median, mesh.boundary))
            ]
        )
    slopes = np.log2(np.divide(*errors))
    assert (slopes[::2] > order - 0.2).all()
    assert (slopes[1::2] > order - 0.5).all()


def test_order_on_an_irregular_torus():
    """Of k1, k2 and the direction d1, against closed forms."""
    errors = []
    for side in (48, 96):
        vertices, faces = torus(side, "irregular")
        found = curvlib.estimate((vertices, faces), "jet", degree=4, rings=3)
        x, y, _ = vertices.T
        around = np.hypot(x, y)
        d1 = np.abs((found.d1[:, 1] * x - found.d1[:, 0] * y) / around)
        # k = 1 along the tube's circle, (around - 2) / around along the other.
        errors.append(
            [
                np.abs(found.k1 - 1).mean(),
                np.abs(found.k2 - (around - 2) / around).mean(),
                np.arcsin(np.minimum(d1, 1)).mean(),
            ]
        )
    assert (np.log2(np.divide(*errors)) > 2.7).all()


def cubic(x, y):
    return 0.2 * x - 0.1 * y + x * x - x * y - y * y / 2 + x**3 - 2 * x * y * y + y**3


@pytest.mark.parametrize(("name", "options"), [("quadric", {}), ("jet", {"degree": 3, "rings": 3})])
def test_exact_on_graphs_of_the_degree(name, options):
    """With z along the z axis: along another one, f is no polynomial."""

    def f(x, y):
        return cubic(x, y) if name == "jet" else x * x - x * y - y * y / 2

    mesh = graph(17, lambda x, y: f(x / 4, y / 4))
    found = curvlib.estimate(mesh, upright(name), **options)
    x, y, _ = mesh.vertices.T
    K, H = exact(x, y, lambda x, y: f(x / 4, y / 4))
    np.testing.assert_allclose(found.K, K, atol=1e-7)
    np.testing.assert_allclose(found.H, H, atol=1e-7)


def upright(name):
    lowest = 1 if name == "quadric" else 0

    def along_z(disk, degree: Literal[2, 3] = 2, rings: Literal[2, 3] = 2):
        X, Y, N = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
        return from_graph(*fit_polynomial(disk, X, Y, N, lowest, degree)[0], X, Y, N)[0]

    return along_z


def test_float32_far_from_the_origin():
    """Coordinates as a file holds them: values as of the same numbers in float64."""
    vertices, faces = torus(24, "irregular")
    rounded = (vertices + 1e6 / 2**10).astype(np.float32)
    single = curvlib.estimate((rounded, faces), "quadric")
    double = curvlib.estimate((rounded.astype(float), faces), "quadric")
    np.testing.assert_array_equal(single.K, double.K)
    far = curvlib.estimate((vertices + 1e6, faces), "jet", degree=4, rings=3)
    near = curvlib.estimate((vertices, faces), "jet", degree=4, rings=3)
    np.testing.assert_allclose(far.K, near.K, atol=1e-5)
