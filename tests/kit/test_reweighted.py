"""Fits with changing weights: against NumPy and SciPy, and by what defines them."""

import numpy as np
import pytest
from scipy.optimize import linprog
from scipy.stats import norm

from curvlib.kit.compiled import compiled
from curvlib.kit.disk import ROWS, SPACE, Disk
from curvlib.kit.polynomial import monomials
from curvlib.kit.reweighted import (
    NEAR,
    RESIDUAL,
    WEIGHT,
    consistency,
    fit_absolute,
    fit_biweight,
    fit_weighted,
    scale,
    set_biweights,
    weigh_by_distance,
)

X, Y, N = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
COEFFICIENTS = np.array([0.02, 0.1, -0.2, 0.3, -0.1, 0.2])


@compiled
def measure(disk):
    monomials(disk, X, Y, N, 4)


def design(points):
    x, y, _ = points.T
    return np.stack((x**0, x, y, x * x, x * y, y * y), -1)


def disk_of(points, hops=None):
    """A Disk of points (m, 3), measured, in the unit of the points, with garbage elsewhere."""
    count = len(points)
    n = -(-count // 8) * 8
    rows, space = np.full((ROWS, n), np.nan), np.full(SPACE, np.nan)
    rows[:4], rows[:3, :count], rows[3, :count] = 0, points.T, 1
    around = np.zeros(n, np.uint8)
    around[:count] = 1 if hops is None else hops
    none = np.empty(0)
    disk = Disk(rows[:3], rows[3], around, none, N, N, 0.0, True, 1.0, count, rows, space, None)
    measure(disk)
    rows[NEAR] = rows[3]
    return disk


def cloud(seed, count=18, noise=0.0):
    rng = np.random.default_rng(seed)
    points = rng.uniform(-1, 1, (count, 3))
    points[:, 2] = design(points) @ COEFFICIENTS + noise * rng.normal(size=count)
    return points


def test_weighted_fits_against_numpy():
    """The vertex itself is a point at the origin; residuals are absolute."""
    points, rng = cloud(1, noise=0.1), np.random.default_rng(2)
    disk, weights, own = disk_of(points), rng.uniform(0, 1, 18), 0.7
    disk.rows[WEIGHT] = 0
    disk.rows[WEIGHT, :18] = weights
    quadric = np.r_[np.zeros(6), own]
    assert fit_weighted(disk, quadric)
    every = np.vstack((points, np.zeros(3)))
    root = np.sqrt(np.r_[weights, own])
    expected = np.linalg.lstsq(design(every) * root[:, None], every[:, 2] * root, rcond=None)[0]
    np.testing.assert_allclose(quadric[:6], expected, atol=1e-12)
    residuals = np.abs(points[:, 2] - design(points) @ expected)
    np.testing.assert_allclose(disk.rows[RESIDUAL, :18], residuals, atol=1e-12)


def test_nothing_where_the_quadric_is_not_determined():
    """All points on a circle through the vertex."""
    angle = np.arange(12.0)
    points = np.stack((1 + np.cos(angle), np.sin(angle), 0 * angle), -1)
    disk, quadric = disk_of(points), np.ones(7)
    disk.rows[WEIGHT] = disk.rows[3]
    assert not fit_weighted(disk, quadric)
    assert (quadric == 1).all()
    assert not fit_absolute(disk, quadric, 1.0)


@pytest.mark.parametrize("count", [9, 18, 37])
def test_scale(count):
    """A quantile, and that of Gaussian residuals is their deviation."""
    rng = np.random.default_rng(3)
    disk, factor = disk_of(cloud(4, count)), consistency(count)
    most = (count + 5) // 2
    quantile = norm.ppf((1 + most / (count + 1)) / 2)
    assert factor * quantile == pytest.approx(1 + 5 / (count - 5), rel=0.01)
    for _ in range(5):
        residuals = np.abs(rng.normal(size=count)).round(1)  # with ties
        disk.rows[RESIDUAL, :count] = residuals
        assert scale(disk, 1.0) == max(np.sort(residuals)[most - 1], 1e-6)
        np.testing.assert_array_equal(disk.rows[RESIDUAL, :count], residuals)


def test_least_absolute_residuals_against_linear_programming():
    points = cloud(5, 30, noise=0.1)
    points[:4, 2] += 1
    disk, quadric = disk_of(points), np.zeros(7)
    assert fit_absolute(disk, quadric, consistency(30))
    A, z = design(np.vstack((points, np.zeros(3)))), np.r_[points[:, 2], 0]
    cost = np.r_[np.zeros(6), np.ones(len(z))]
    limits = np.block([[A, -np.eye(len(z))], [-A, -np.eye(len(z))]])
    least = linprog(cost, limits, np.r_[z, -z], bounds=[(None, None)] * 6 + [(0, None)] * len(z))
    assert np.abs(A @ quadric[:6] - z).sum() < 1.05 * least.fun
    squares = np.linalg.lstsq(A, z, rcond=None)[0]
    assert np.abs(A @ squares - z).sum() > 1.1 * least.fun


def test_biweights_leave_out_what_is_far():
    """At the end the quadric is the weighted fit of its own biweights; where the others are on a
    quadric, it is that one."""
    points = cloud(6, noise=0.01)
    points[:3, 2] += 0.8
    disk, quadric, factor = disk_of(points), np.zeros(7), consistency(18)
    assert fit_absolute(disk, quadric, factor)
    found = fit_biweight(disk, quadric, factor, 4.685)
    assert found == pytest.approx(scale(disk, factor), rel=1e-6)
    before = quadric[:6].copy()
    set_biweights(disk, quadric, 4.685 * found)
    assert (disk.rows[WEIGHT, :3] == 0).all()
    r = disk.rows[RESIDUAL, 3:18] / (4.685 * found)
    np.testing.assert_allclose(disk.rows[WEIGHT, 3:18], (1 - np.minimum(r, 1) ** 2) ** 2)
    assert fit_weighted(disk, quadric)
    np.testing.assert_allclose(quadric[:6], before, atol=1e-8)
    exact = cloud(7)
    exact[:3, 2] += 0.8
    disk = disk_of(exact)
    quadric[6] = 0
    assert fit_absolute(disk, quadric, factor)
    fit_biweight(disk, quadric, factor, 4.685)
    # The vertex is no point of that quadric, and is left out as well.
    np.testing.assert_allclose(quadric[:6], COEFFICIENTS, atol=1e-9)
    assert quadric[6] == 0


def test_distance_does_not_decide():
    """Weights fall from 1.5 median edges a hop on, and the size is that of the others."""
    points = np.random.default_rng(8).normal(size=(18, 3))
    hops = np.repeat((1, 2), (6, 12))
    points *= (hops / np.linalg.norm(points, axis=1))[:, None]
    points[3] *= 6
    disk = disk_of(points, hops)
    assert weigh_by_distance(disk) == pytest.approx(2)
    weights = disk.rows[NEAR]
    assert weights[3] == pytest.approx((1.5 / 6) ** 4)
    np.testing.assert_allclose(np.delete(weights, 3), np.repeat((1.0, 0.0), (17, 6)))
