"""Polynomials over a disk: against NumPy's least squares, and what points determine."""

import numpy as np
import pytest

import curvlib
from curvlib.kit.compiled import compiled
from curvlib.kit.disk import ROWS, SPACE, Disk
from curvlib.kit.lanes import LANES
from curvlib.kit.polynomial import HIGHEST, MOMENTS, MONOMIALS, fit_polynomial, terms

X, Y, N = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


@compiled
def fit(disk, lowest, degree):
    return fit_polynomial(disk, X, Y, N, lowest, degree)


def disk_of(points, weights=None):
    """A Disk of points (m, 3), with garbage where there is memory for estimators."""
    count = len(points)
    n = -(-count // 8) * 8
    rows, space = np.full((ROWS, n), np.nan), np.full(SPACE, np.nan)
    rows[:4] = 0
    rows[:3, :count] = points.T
    rows[3, :count] = 1 if weights is None else weights
    radius = float(np.linalg.norm(points, axis=1).max(initial=0))
    none = np.empty(0)
    hops = np.ones(n, np.uint8)
    return Disk(rows[:3], rows[3], hops, none, N, N, 0.0, True, radius, count, rows, space, None)


def points_of(rng, count, z):
    x, y = rng.uniform(-1, 1, (2, count))
    return np.column_stack((x, y, z(x, y)))


def expected(points, weights, lowest, degree):
    """f_x, f_y, f_xx, f_xy, f_yy by the singular value decomposition."""
    if lowest == 0:
        points, weights = np.vstack((points, [[0, 0, 0]])), np.append(weights, 1)
    x, y, z = points.T
    powers = [(s - j, j) for s in range(lowest, degree + 1) for j in range(s + 1)]
    columns = np.column_stack([x**i * y**j for i, j in powers])
    c = dict(zip(powers, np.linalg.lstsq(weights[:, None] * columns, weights * z, rcond=None)[0]))
    return c[1, 0], c[0, 1], 2 * c[2, 0], c[1, 1], 2 * c[0, 2]


@pytest.mark.parametrize("lowest", [0, 1])
@pytest.mark.parametrize("degree", range(2, HIGHEST + 1))
@pytest.mark.parametrize("scale", [1.0, 1e-30, 1e30])
def test_against_a_singular_value_decomposition(lowest, degree, scale):
    rng = np.random.default_rng(degree)
    count = terms(degree) + 20
    points = points_of(rng, count, lambda x, y: np.sin(2 * x + y) + np.cos(y) - 1)
    weights = rng.uniform(0.5, 1, count)
    if lowest == 0:  # beside which the vertex has weight 1, whatever their scale
        weights[:] = 1
    found, reached = fit(disk_of(points * scale, weights), lowest, degree)
    assert reached == degree
    slopes, second = np.split(expected(points, weights, lowest, degree), [2])
    np.testing.assert_allclose(found[:2], slopes, atol=1e-8)
    np.testing.assert_allclose(np.array(found[2:]) * scale, second, atol=1e-8)


@pytest.mark.parametrize("degree", range(2, 7))
def test_exact_on_polynomials(degree):
    rng = np.random.default_rng(degree)
    c = {(s - j, j): rng.normal() for s in range(1, degree + 1) for j in range(s + 1)}
    points = points_of(rng, 60, lambda x, y: sum(v * x**i * y**j for (i, j), v in c.items()))
    for lowest in (0, 1):
        found, _ = fit(disk_of(points), lowest, degree)
        exact = c[1, 0], c[0, 1], 2 * c[2, 0], c[1, 1], 2 * c[0, 2]
        assert found == pytest.approx(exact, rel=1e-9)


def test_the_degree_that_points_determine():
    """Too few points, points on a line, on a conic, on two grids' worth of lines."""
    rng = np.random.default_rng(0)

    def z(x, y):
        return x * x - y * y / 2 + x * y

    for count in (0, 1, 4, 7, 8, 12, 13, 18, 19, 40):
        points = points_of(rng, count, z)
        # Through the vertex, terms(d) - 1 points determine degree d.
        highest = max(d for d in range(6) if terms(d) - 1 <= max(count, 2))
        found, reached = fit(disk_of(points), 1, 5)
        assert reached == max(highest, 1)
        if highest >= 2:
            assert found == pytest.approx((0, 0, 2, 1, -1), abs=1e-9)
        else:
            assert np.isnan(found).all()
    t = rng.uniform(-1, 1, 30)
    line = np.column_stack((t, 2 * t, t * t))
    assert fit(disk_of(line), 1, 3)[1] == 1
    around = np.pi * t
    conic = np.column_stack((1 + np.cos(around), np.sin(around), t))
    assert fit(disk_of(conic), 1, 3)[1] == 1
    # On three parallel lines x (x^2 - 1) vanishes.
    lines = np.column_stack((rng.integers(-1, 2, 60), rng.uniform(-1, 1, 60), np.zeros(60)))
    assert fit(disk_of(lines), 1, 4)[1] == 2


@pytest.mark.parametrize("degree", range(2, HIGHEST + 1))
def test_no_subnormal_number_is_taken_from_memory(degree):
    """Vectors of them in the elimination doubled the time of a fit."""
    points = points_of(np.random.default_rng(0), terms(degree) + 20, lambda x, y: x * y + x**3)
    disk = disk_of(points)
    disk.space[:] = 5e-324
    assert fit(disk, 1, degree)[1] == degree
    p = terms(degree) - 1
    system = disk.space[MOMENTS + 3 * MONOMIALS :][: p * ((p + LANES) // LANES * LANES)]
    assert ((system == 0) | (np.abs(system) > 1e-300)).all()


def test_degrees_that_there_is_no_room_for():
    with pytest.raises(curvlib.InputError, match="a degree above 9"):
        fit(disk_of(np.eye(3)), 1, HIGHEST + 1)
