"""Polynomials fitted to heights and slopes: against NumPy's least squares of the same residuals."""

import numpy as np
import pytest

from curvlib.kit.compiled import compiled
from curvlib.kit.disk import ROWS, SPACE, Disk, Walk
from curvlib.kit.hermite import fit_hermite
from curvlib.kit.vectors import tangents

N = np.array((0.1, -0.2, np.sqrt(0.95)))
X, Y = map(np.array, tangents(tuple(N)))
WEIGHT = 0.03


@compiled
def fit(disk, normals, X, Y, N, degree):
    return fit_hermite(disk, normals, X, Y, N, degree, 0.03, 1e-5)


def fitted(e, normals, degree):
    """p, q, r, s, t; the gain; derivatives (neighbour, 5, 2)."""
    n = -(-len(e) // 8) * 8
    rows, space = np.full((ROWS, n), np.nan), np.full(SPACE, np.nan)
    rows[:4] = 0
    rows[:3, : len(e)], rows[3, : len(e)] = e.T, 1
    none, radius = np.empty(0), float(np.linalg.norm(e, axis=1).max(initial=0))
    walk = Walk(*[None] * 8, rows.reshape(-1), *[None] * 3)
    own = tuple(N), tuple(N), 0.0, True, radius, len(e), rows, space, walk
    disk = Disk(rows[:3], rows[3], np.ones(n, np.uint8), none, *own)
    padded = np.full((3, 1 + disk.rows.shape[1]), np.nan)
    padded[:, 1 : 1 + len(e)] = normals.T
    f, gain, derivatives = fit(disk, padded, tuple(X), tuple(Y), tuple(N), degree)
    return np.array(f), gain, derivatives[:, : len(e)].T.copy().reshape(-1, 5, 2)


def expected(e, normals, degree):
    """From the definition: whitened coordinates, all residuals as rows, the pseudoinverse."""
    plane = np.column_stack((e @ X, e @ Y))
    to_plane = np.linalg.cholesky(2 / len(e) * plane.T @ plane)
    xi, eta = np.linalg.solve(to_plane, plane.T)
    heights = normals @ N
    slopes = -np.column_stack((normals @ X, normals @ Y)) / heights[:, None] @ to_plane
    powers = [(s - j, j) for s in range(1, degree + 1) for j in range(s + 1)]
    value = np.column_stack([xi**i * eta**j for i, j in powers])
    by_xi = np.column_stack([i * xi ** max(i - 1, 0) * eta**j for i, j in powers])
    by_eta = np.column_stack([j * xi**i * eta ** max(j - 1, 0) for i, j in powers])
    inverse = np.linalg.pinv(np.vstack((value, WEIGHT * by_xi, WEIGHT * by_eta)), rcond=1e-12)
    c = inverse @ np.concatenate((e @ N, WEIGHT * slopes[:, 0], WEIGHT * slopes[:, 1]))
    back = np.linalg.inv(to_plane)
    p, q = c[:2] @ back
    (r, s), (_, t) = back.T @ [[2 * c[2], c[3]], [c[3], 2 * c[4]]] @ back
    own = WEIGHT * inverse[:2, len(e) :].reshape(2, 2, -1) / heights**2
    return np.array((p, q, r, s, t)), np.linalg.norm(own)


def points(rng, count, f):
    """Points of a graph over the plane of X and Y, stretched, and their normals."""
    x, y = rng.uniform(-1, 1, (2, count)) * [[1.0], [0.4]]
    h = 1e-6
    p, q = (f(x + h, y) - f(x - h, y)) / (2 * h), (f(x, y + h) - f(x, y - h)) / (2 * h)
    normals = N - p[:, None] * X - q[:, None] * Y
    return (
        x[:, None] * X + y[:, None] * Y + f(x, y)[:, None] * N,
        normals / np.linalg.norm(normals, axis=1)[:, None],
    )


@pytest.mark.parametrize(("degree", "count"), [(2, 5), (4, 6), (5, 18), (6, 18), (6, 30)])
def test_against_the_pseudoinverse(degree, count):
    rng = np.random.default_rng(degree)
    e, normals = points(rng, count, lambda x, y: 0.3 * np.sin(2 * x + y) + 0.2 * x * y)
    f, gain, _ = fitted(e, normals, degree)
    reference, norm = expected(e, normals, degree)
    np.testing.assert_allclose(f, reference, rtol=1e-6, atol=1e-6)
    assert gain == pytest.approx(norm, rel=1e-6)


@pytest.mark.parametrize("degree", [3, 4, 6])
def test_exact_on_polynomials(degree):
    rng = np.random.default_rng(degree)
    c = {(s - j, j): rng.normal() / 4 for s in range(1, degree + 1) for j in range(s + 1)}
    count = 18 if degree == 6 else 8
    e, normals = points(rng, count, lambda x, y: sum(v * x**i * y**j for (i, j), v in c.items()))
    f, _, _ = fitted(e, normals, degree)
    exact = c[1, 0], c[0, 1], 2 * c[2, 0], c[1, 1], 2 * c[0, 2]
    np.testing.assert_allclose(f, exact, atol=1e-7)


def test_derivatives_by_the_normals_of_neighbours():
    """By central differences, N_j - u X_j - v Y_j being the changed normal."""
    rng = np.random.default_rng(1)
    e, normals = points(rng, 18, lambda x, y: 0.3 * np.sin(2 * x + y) + 0.2 * x * y)
    _, _, derivatives = fitted(e, normals, 6)
    for j in (0, 7, 17):
        for k in range(2):
            sides = []
            for change in (1e-5, -1e-5):
                changed = normals.copy()
                changed[j] -= change * np.array(tangents(tuple(normals[j]))[k])
                changed[j] /= np.linalg.norm(changed[j])
                sides.append(fitted(e, changed, 6)[0])
            slope = (sides[0] - sides[1]) / 2e-5
            assert np.abs(derivatives[j, :, k] - slope).max() < 1e-6 * np.abs(slope).max()


def test_points_that_do_not_determine_it():
    """Too few, on a line, on one parabola through the vertex with slopes along it alone."""
    rng = np.random.default_rng(2)
    for count, degree in ((8, 6), (4, 4), (1, 2), (0, 2)):
        e, normals = points(rng, count, lambda x, y: x * y)
        assert fitted(e, normals, degree)[1] == np.inf
    t = np.linspace(-1, 1, 18)
    line = np.outer(t, X + 2 * Y)
    assert fitted(line, np.tile(N, (18, 1)), 4)[1] == np.inf
