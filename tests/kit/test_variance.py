"""Variances of fitted curvatures, against NumPy's least squares and against repeated noise."""

import numpy as np
import pytest

import curvlib
from curvlib.estimators._errors import assessed
from curvlib.meshes.jittered import graph
from curvlib.passes import Passes


def quadratic(x, y):
    return 0.4 * x * x - 0.25 * y * y + 0.3 * x * y


def inner(mesh):
    x, y, _ = mesh.vertices.T
    return np.flatnonzero((np.abs(x) < 0.5) & (np.abs(y) < 0.5)).astype(np.int32)


def two_rings(mesh, v):
    near = {v}
    for _ in range(2):
        near |= set(mesh.faces[np.isin(mesh.faces, list(near)).any(1)].ravel().tolist())
    return np.array([v, *sorted(near - {v})])


def test_residuals_and_variance_of_H_are_those_of_least_squares():
    """In a frame that is turned about the normal; the gradient of H is by differences."""
    mesh = graph(20, lambda x, y: 0.02 * np.sin(9 * x + 5 * y * y), 3)
    v = int(inner(mesh)[7])
    found = Passes(mesh, 1).field(assessed, np.array([v], np.int32), degree=2, rings=2)[:, 0]
    e = mesh.vertices[two_rings(mesh, v)] - mesh.vertices[v]
    corners = mesh.vertices[mesh.faces[(mesh.faces == v).any(1)]]
    N = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).sum(0)
    N /= np.linalg.norm(N)
    X = np.cross(N, [1.0, 0.3, 0.2])
    X /= np.linalg.norm(X)
    x, y, z = e @ X, e @ np.cross(N, X), e @ N
    A = np.column_stack((np.ones_like(x), x, y, x * x, x * y, y * y))
    c, squares, *_ = np.linalg.lstsq(A, z, rcond=None)
    inverse = np.linalg.inv(A.T @ A)

    def H(c):
        p, q, r, s, t = c[1], c[2], 2 * c[3], c[4], 2 * c[5]
        g = 1 + p * p + q * q
        return -((1 + q * q) * r - 2 * p * q * s + (1 + p * p) * t) / (2 * g**1.5)

    assert found[1] == pytest.approx(H(c), rel=1e-9)
    steps = 1e-5 * np.eye(6)
    by = np.array([(H(c + d) - H(c - d)) / 2e-5 for d in steps])
    assert found[11] == pytest.approx(by @ inverse @ by, rel=1e-6)
    assert found[15] == pytest.approx(squares[0], rel=1e-9)
    assert found[16] == len(x) - 6


@pytest.mark.parametrize(("degree", "rings"), [(2, 3), (4, 3)])
def test_variances_are_those_of_repeated_noise(degree, rings):
    """A polynomial of the degree has no bias: what is left of the draws is noise alone."""
    exact, rng, draws = graph(16, quadratic, 2), np.random.default_rng(1), 250
    some, sigma = inner(exact), 2e-4
    values = []
    for _ in range(draws):
        vertices = exact.vertices.copy()
        vertices[:, 2] += sigma * rng.standard_normal(len(vertices))
        mesh = curvlib.Mesh(vertices, exact.faces)
        fit = {"degree": degree, "rings": rings, "fit": "approximation"}
        found = curvlib.estimate(mesh, "jet", **fit)
        values.append([x[some] for x in (found.K, found.H, found.k1, found.k2)])
    passes = Passes(exact, 1)
    known = passes.field(assessed, some, degree=degree, rings=rings)
    # Noise is along z, heights are along the normals.
    N = passes.field(normal, some)[2]
    expected = known[10:14] * (sigma * N) ** 2
    ratios = np.var(values, axis=0) / expected
    assert ratios.mean(1) == pytest.approx(np.ones(4), rel=0.05)


def normal(disk):
    return disk.normal
