"""Least squares against LAPACK's, by singular values, of any rank."""

import numpy as np
import pytest

from curvlib.kit.fit import fold, least_squares

SYSTEMS = 200
CUTOFF = 1e-3


def systems(kind, rows, seed=0):
    """Design matrices (SYSTEMS, rows, 3) and right-hand sides (SYSTEMS, rows)."""
    rng = np.random.default_rng(seed)
    a, z = rng.normal(size=(SYSTEMS, rows, 3)), rng.normal(size=(SYSTEMS, rows))
    u, s, vt = np.linalg.svd(a, full_matrices=False)
    factors = {
        "regular": (1, 1, 1),
        "weak": (1, 1e-2, 10 * CUTOFF),
        "rank 2": (1, 1, 0),
        "nearly rank 2": (1, 1e-1, CUTOFF / 10),
        "rank 1": (1, 0, 0),
        "rank 0": (0, 0, 0),
        "large": (1e150, 1e150, 1e149),
        "small": (1e-150, 1e-150, 0),
    }[kind]
    scaled = np.array(factors)[: s.shape[1]] * (1 + rng.random(s.shape))
    return (u * scaled[:, None]) @ vt, z


@pytest.mark.parametrize("rows", [1, 2, 3, 4, 6, 20])
@pytest.mark.parametrize(
    "kind", ["regular", "weak", "rank 2", "nearly rank 2", "rank 1", "rank 0", "large", "small"]
)
def test_minimum_norm_solution(kind, rows):
    a, z = systems(kind, rows)
    columns = np.concatenate((a, z[..., None]), axis=2).transpose(2, 1, 0).copy()
    found = least_squares(columns, CUTOFF).T
    for k in range(SYSTEMS):
        expected, _, rank, s = np.linalg.lstsq(a[k], z[k], rcond=CUTOFF)
        error = 1e-13 * np.linalg.norm(z[k]) * s[0] / s[rank - 1] ** 2 if rank else 0
        np.testing.assert_allclose(found[k], expected, rtol=0, atol=error)


@pytest.mark.parametrize("where", [(0, 1), (2, 0), (3, 3)])
def test_not_a_number_stays_in_its_system(where):
    a, z = systems("rank 2", 4)
    columns = np.concatenate((a, z[..., None]), axis=2).transpose(2, 1, 0).copy()
    expected = least_squares(columns.copy(), CUTOFF)
    columns[(*where, 7)] = np.nan
    found = least_squares(columns, CUTOFF)
    assert np.isnan(found[:, 7]).all()
    np.testing.assert_array_equal(np.delete(found, 7, axis=1), np.delete(expected, 7, axis=1))


@pytest.mark.parametrize("rows", [3, 5, 20])
def test_folded_rows_have_the_same_solution(rows):
    a, z = systems("regular", rows)
    columns = np.concatenate((a, z[..., None]), axis=2).transpose(2, 1, 0).copy()
    expected = least_squares(columns.copy(), CUTOFF)
    fold(columns)
    assert not columns[:, 3:].any()
    np.testing.assert_allclose(least_squares(columns, CUTOFF), expected, rtol=1e-9)
