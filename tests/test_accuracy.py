"""Norms, slopes, verdicts and ranks against numbers that can be worked out by hand."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from curvlib import accuracy

LABELS = {"surface": "s", "diagonal": "same", "reading": "default"}


def mean_errors(values, n=(8, 16, 32), estimator="e", quantity="K"):
    rows = [
        LABELS | {"estimator": estimator, "n": m, "quantity": quantity, "norm": "mean", "value": x}
        for m, x in zip(n, values)
    ]
    return pd.DataFrame(rows)


ROUNDING = {("s", "K"): 1e-9, ("s", "H"): 1e-9}


def test_error_norms():
    nan = np.nan
    exact = SimpleNamespace(K=np.array([1.0, 2, nan, 4, 5]), H=np.array([1.0, -1, nan, 2, 2]))
    estimate = SimpleNamespace(K=np.array([1.5, 2, 3, nan, 3]), H=np.array([-1.0, -2, 1, nan, 3]))
    rows = pd.DataFrame(accuracy.error_rows(exact, estimate, **LABELS))
    value = rows.set_index(["quantity", "norm"]).value
    assert value["K", "mean"] == pytest.approx(2.5 / 3)
    assert value["K", "max"] == 2
    assert value["K", "q95"] == pytest.approx(np.quantile([0.5, 0, 2], 0.95))
    # | |H| - |H_est| | is blind to the sign of the first vertex.
    assert value["H", "mean"] == pytest.approx(2 / 3)
    assert value["H", "mean-signed"] == pytest.approx(4 / 3)
    assert set(rows.vertices) == {3}
    assert set(rows.undefined) == {2}


def test_a_quantity_that_is_not_estimated_has_no_rows():
    exact = SimpleNamespace(K=np.ones(3), H=np.ones(3))
    estimate = SimpleNamespace(K=np.ones(3), H=np.full(3, np.nan))
    rows = pd.DataFrame(accuracy.error_rows(exact, estimate, **LABELS))
    assert set(rows.quantity) == {"K"}


@pytest.mark.parametrize(
    ("values", "slope", "verdict"),
    [
        ([4, 1, 0.25], -2, "converges"),
        ([2, 1, 0.5], -1, "converges"),
        ([1, 1, 1], 0, "stagnates"),
        ([1, 2, 4], 1, "diverges"),
        ([1e-12, 1e-11, 1e-10], np.nan, "exact"),
        ([1e-15, 1, 0.25], -2, "converges"),
    ],
)
def test_slopes_and_verdicts(values, slope, verdict):
    row = accuracy.convergence(mean_errors(values), ROUNDING).iloc[0]
    assert row.slope == pytest.approx(slope, abs=1e-12, nan_ok=True)
    assert row.verdict == verdict
    assert row.monotone == bool((np.diff(values) < 0).all())


def test_standard_error_is_that_of_the_textbook():
    x = np.log([8, 16, 32, 64])
    y = -2 * x + [0.1, -0.1, 0.05, -0.05]
    row = accuracy.convergence(mean_errors(np.exp(y), (8, 16, 32, 64)), ROUNDING).iloc[0]
    (slope, _), covariance = np.polyfit(x, y, 1, cov=True)
    assert row.slope == pytest.approx(slope)
    assert row.stderr == pytest.approx(np.sqrt(covariance[0, 0]))


def test_ties_at_rounding_level_share_a_rank():
    values = {"a": 1e-14, "b": 3e-10, "c": 0.5, "d": 0.5 * (1 + 1e-12), "e": 0.6}
    table = pd.concat(mean_errors([x], (8,), name) for name, x in values.items())
    ranks = accuracy.ranks(table, ROUNDING).set_index("estimator")["rank"]
    assert ranks.to_dict() == {"a": 1, "b": 1, "c": 3, "d": 3, "e": 5}
