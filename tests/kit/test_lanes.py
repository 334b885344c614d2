"""Rows as vectors: the same bits as the same sums in NumPy."""

import numpy as np
import pytest

from curvlib.kit import combinations, lanes
from curvlib.kit.compiled import compiled, kernel
from curvlib.kit.parts import part


@kernel
def _all(rows, out, factors, weights):
    lanes.multiply(rows, 3, 0, 1)
    lanes.project(rows, 4, 0, (0.3, -0.7, 1.1))
    lanes.eliminate(out, 2, factors)
    s = lanes.dot(rows, 0, 1)
    combinations.substitute(out, 3, 7, factors)
    combinations.combine(rows, 3, 2, 0, 3, weights)
    return s


@compiled
def compiled_all(rows, out, factors, weights):
    return _all(rows, out, factors, weights)


@pytest.mark.parametrize("n", [0, 8, 24, 64])
def test_as_in_numpy(n):
    rng = np.random.default_rng(n)
    rows, factors = rng.normal(size=(5, n)), rng.normal(size=11)
    out, weights = rng.normal(size=(11, 16)), rng.normal(size=(3, 8))
    expected = [x.copy() for x in (rows, out)]
    s = compiled_all(rows, out, factors, weights)
    assert s == _all.py_func(*expected, factors, weights)
    np.testing.assert_array_equal(rows, expected[0])
    np.testing.assert_array_equal(out, expected[1])
    assert s == pytest.approx(rows[0] @ rows[1], rel=1e-13)


def test_elimination_by_hand():
    rows = np.random.default_rng(0).normal(size=(10, 16))
    expected, factors = rows.copy(), np.linspace(1, 2, 10)
    lanes.eliminate(rows, 3, factors)
    for i in range(10):
        for j in range(i, 16):
            change = factors[i] * expected[3, j] if i > 3 else 0
            assert rows[i, j] == expected[i, j] - change


@compiled
def _written(array):
    rows = part(array, 2, (2, 3))
    rows[1, 0] = 7
    return rows.sum(), part(array, 3, (2,))[1]


def test_parts_are_views():
    array = np.arange(10.0)
    assert _written(array) == (2 + 3 + 4 + 7 + 6 + 7, 4)
    assert array[5] == 7
