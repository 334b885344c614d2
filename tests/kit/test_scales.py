"""Polynomials over more and more rings: exact where they should be, and statistics of them."""

import numpy as np
import pytest

from curvlib.kit.scales import RINGS, forms, means, nearest, ratios
from curvlib.meshes.jittered import graph, jittered
from curvlib.passes import Passes


@pytest.mark.parametrize("degree", [6, 4])
def test_a_graph_of_the_degree_has_one_form_at_all_scales(degree):
    """About a point where its slope is zero; f_xx and f_yy are along any axes of the plane."""
    mesh = graph(41, lambda x, y: 0.5 * x**2 + 0.2 * x * y - 0.3 * y**2 + 0.4 * x**degree, 1)
    vertices = mesh.vertices.copy()
    v = np.argmin((vertices[:, :2] ** 2).sum(1))
    vertices[v] = 0
    passes, scales = Passes(mesh.moved(vertices), 1), RINGS[degree]
    through, *found = passes.field(forms, np.array([v]), degree=degree, rings=scales[-1])[:, 0]
    assert through == pytest.approx(0.2 if degree == 6 else np.nan, abs=1e-8, nan_ok=True)
    xx, xy, yy = np.reshape(found, (-1, 3)).T
    assert np.isfinite(xx).sum() == len(scales)
    xx, xy, yy = (x[: len(scales)] for x in (xx, xy, yy))
    np.testing.assert_allclose(xx + yy, 0.4, atol=2e-3)
    determinants = xx * yy - xy**2
    np.testing.assert_allclose(determinants, -0.6 - 0.04, atol=2e-3)


def test_a_scale_that_adds_no_vertices_is_none():
    """Of 64 vertices no disk has eight rings: the same fit again would seem to stand still."""
    passes = Passes(jittered("ellipsoid", 8, 1), 1)
    found = passes.field(forms, degree=4, rings=13)[1:].reshape(7, 3, 64)
    assert np.isfinite(found[0]).all()
    assert np.isnan(found[4:]).all()


def test_means_leave_out_the_largest():
    squares = np.r_[np.ones(19), 1e9, np.nan]
    near = np.array([[0, 1, 2], [18, 19, 20]])
    np.testing.assert_allclose(means(squares, near, 0.05), [1, (1 + 1e9) / 2, 1])
    assert means(np.full(3, np.nan), np.array([[0, 1, 2]]), 0.05).tolist() == [np.inf, np.inf]


def test_ratios_of_medians():
    a, b = np.array([-2.0, 2, 2, 50]), np.array([1.0, -1, 1, 1])
    np.testing.assert_allclose(ratios(a, b, np.array([[0, 1, 2], [1, 3, 3]])), [2, 50, 2])


def test_nearest_of_a_sample():
    points = np.random.default_rng(1).random((40, 3)) + 1e6
    found = nearest(points, points[::4], 8)
    distances = np.linalg.norm(points[:, None] - points[None, ::4], axis=2)
    np.testing.assert_array_equal(np.sort(found), np.sort(np.argsort(distances)[:, :2]))
