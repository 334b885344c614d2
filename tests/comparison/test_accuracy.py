"""Norms, slopes, verdicts and ranks against numbers that can be worked out by hand."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

import curvlib
from curvlib.comparison import accuracy
from curvlib.comparison.norms import counted_vertices, error_rows

ROUNDING = {("s", "K"): 1e-9, ("s", "H"): 1e-9}


def variants(values, n=(8, 16, 32), **labels):
    """Rows as of `results.run_estimator`, with a largest curvature of 1: rounding is 1e-9."""
    first = {"surface": "s", "diagonal": "same", "triangles": 0, "largest_k": 1.0}
    first |= {"estimator": "e", "variant": "-", "counted": "interior", "quantity": "K"}
    first |= {"norm": "mean", "vertices": 9, "undefined": 1}
    return pd.DataFrame([first | labels | {"n": m, "value": x} for m, x in zip(n, values)])


def test_error_norms():
    nan = np.nan
    exact = SimpleNamespace(K=np.array([1.0, 2, nan, 4, 5]), H=np.array([1.0, -1, nan, 2, 2]))
    estimate = SimpleNamespace(K=np.array([1.5, 2, 3, nan, 3]), H=np.array([-1.0, -2, 1, nan, 3]))
    rows = pd.DataFrame(error_rows(exact, estimate, np.ones(5, bool)))
    value = rows.set_index(["quantity", "norm"]).value
    assert value["K", "mean"] == pytest.approx(2.5 / 3)
    assert value["K", "max"] == 2
    assert value["K", "q95"] == pytest.approx(np.quantile([0.5, 0, 2], 0.95))
    # | |H| - |H_est| | is blind to the sign of the first vertex.
    assert value["H", "mean"] == pytest.approx(2 / 3)
    assert value["H", "mean-signed"] == pytest.approx(4 / 3)
    assert set(rows.vertices) == {3}
    assert set(rows.undefined) == {2}
    some = pd.DataFrame(error_rows(exact, estimate, np.array([1, 0, 1, 0, 0], bool)))
    assert some.set_index(["quantity", "norm"]).value["K", "mean"] == 0.5
    assert set(some.vertices) == set(some.undefined) == {1}


def test_a_quantity_that_is_not_estimated_has_no_rows():
    exact = SimpleNamespace(K=np.ones(3), H=np.ones(3))
    estimate = SimpleNamespace(K=np.ones(3), H=np.full(3, np.nan))
    rows = pd.DataFrame(error_rows(exact, estimate, np.ones(3, bool)))
    assert set(rows.quantity) == {"K"}


def test_vertices_without_poles():
    s = curvlib.surface("sphere")
    m = curvlib.tessellate(s, 8)
    left_out = ~counted_vertices(m, s)["without-poles"]
    assert left_out.sum() == 2 * (1 + 8)
    assert np.abs(m.vertices[left_out, 2]).min() > 0.9
    cylinder = curvlib.surface("cylinder")
    assert list(counted_vertices(curvlib.tessellate(cylinder, 8), cylinder)) == ["interior"]


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
    row = accuracy.convergence(variants(values)).iloc[0]
    assert row.slope == pytest.approx(slope, abs=1e-12, nan_ok=True)
    assert row.verdict == verdict
    assert row.monotone == bool((np.diff(values) < 0).all())


def test_what_first_falls_and_then_stays_stagnates():
    row = accuracy.convergence(variants([8, 4, 2, 1, 1, 1], (8, 16, 32, 64, 128, 256))).iloc[0]
    assert row.slope < -0.5
    assert row["tail"] == pytest.approx(0)
    assert row.verdict == "stagnates"


def test_standard_error_and_jackknife_are_those_of_the_textbook():
    x = np.log([8, 16, 32, 64])
    y = -2 * x + [0.1, -0.1, 0.05, -0.05]
    row = accuracy.convergence(variants(np.exp(y), (8, 16, 32, 64))).iloc[0]
    (slope, _), covariance = np.polyfit(x, y, 1, cov=True)
    assert row.slope == pytest.approx(slope)
    assert row.stderr == pytest.approx(np.sqrt(covariance[0, 0]))
    without = [np.polyfit(np.delete(x, i), np.delete(y, i), 1)[0] for i in range(4)]
    spread = np.sqrt(3 / 4 * np.sum((without - np.mean(without)) ** 2))
    assert row.jackknife == pytest.approx(spread)


def test_ties_at_rounding_level_share_a_rank():
    values = {"a": 1e-14, "b": 3e-10, "c": 0.5, "d": 0.5 * (1 + 1e-12), "e": 0.6}
    table = pd.concat(variants([x], (8,), estimator=e, reading="r") for e, x in values.items())
    ranks = accuracy.ranks(table, ROUNDING).set_index("estimator")["rank"]
    assert ranks.to_dict() == {"a": 1, "b": 1, "c": 3, "d": 3, "e": 5}


def test_readings_share_variants():
    """A reading has the rows of the variants that it names; without poles counts the same where
    there are none; on meshes that are not full, and in slopes, it has those only if it is one
    of `more`."""
    tables = [
        variants([4, 2, 1], estimator="a"),
        variants([3, 2, 1], estimator="b"),
        variants([9, 9], (8, 16), estimator="b", variant="x"),
    ]
    rows = accuracy.by_variant(tables, {("same", 8), ("same", 16)})
    readings = pd.DataFrame(
        [
            {"reading": r, "estimator": e, "variant": v, "counted": c, "more": r == "default"}
            for r, e, v, c in (
                ("default", "a", "-", "interior"),
                ("default", "b", "-", "interior"),
                ("other", "a", "-", "without-poles"),
                ("other", "b", "x", "without-poles"),
            )
        ]
    )
    table = (
        accuracy.errors(rows, readings).set_index(["reading", "estimator", "n"]).value.sort_index()
    )
    assert table["default", "a"].tolist() == [4, 2, 1]
    assert table["other", "a"].tolist() == [4, 2]
    assert table["other", "b"].tolist() == [9, 9]
    curves = accuracy.by_reading(rows, readings).set_index(["estimator", "reading"])
    assert curves.finest["a"].to_dict() == {"default": 32, "other": 16}
    assert curves.finest["b", "other"] == 16
    assert curves.slope["b", "other"] == 0
