"""Norms, slopes, verdicts and ranks against numbers that can be worked out by hand."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

import curvlib
from curvlib.comparison import accuracy
from curvlib.comparison.norms import NORMS, counted_vertices, error_rows
from curvlib.meshes.key import MeshKey

READINGS = pd.DataFrame(
    [{"reading": "r", "estimator": "e", "variant": "-", "counted": "interior", "more": False}]
)


def run_rows(values, n=(8, 16, 32), **labels):
    """Rows as of `run_estimator`, with a largest curvature of 1: rounding is 1e-9."""
    first = {"surface": "s", "diagonal": "same", "triangles": 0, "largest_k": 1.0}
    first |= {"estimator": "e", "variant": "-", "counted": "interior", "quantity": "K"}
    first |= {"vertices": 9, "undefined": 1} | labels
    return pd.DataFrame([first | {"n": m} | dict.fromkeys(NORMS, x) for m, x in zip(n, values)])


def curve(values, n=(8, 16, 32)):
    """The row of curves.csv of one curve."""
    full = [MeshKey("s", "same", m) for m in n]
    rows = accuracy.by_variant([run_rows(values, n)], READINGS, full, full)
    (row,) = accuracy.curves(rows, READINGS).itertuples()
    return row


def test_error_norms():
    nan = np.nan
    exact = SimpleNamespace(K=np.array([1.0, 2, nan, 4, 5]), H=np.array([1.0, -1, nan, 2, 2]))
    exact.boundary = np.zeros(5, bool)
    estimate = SimpleNamespace(K=np.array([1.5, 2, 3, nan, 3]), H=np.array([-1.0, -2, 1, nan, 3]))
    estimate.returned = ("K", "H")
    rows = pd.DataFrame(error_rows(exact, estimate, np.ones(5, bool)))
    value = rows.set_index("quantity")
    assert value["mean"]["K"] == pytest.approx(2.5 / 3)
    assert value["median"]["K"] == 0.5
    assert value["median"]["H"] == 1
    assert value["max"]["K"] == 2
    assert value["q95"]["K"] == pytest.approx(np.quantile([0.5, 0, 2], 0.95))
    # | |H| - |H_est| | is blind to the sign of the first vertex.
    assert value["mean"]["H"] == pytest.approx(2 / 3)
    assert value["mean-signed"]["H"] == pytest.approx(4 / 3)
    assert set(rows.vertices) == {3}
    assert set(rows.undefined) == {2}
    some = pd.DataFrame(error_rows(exact, estimate, np.array([1, 0, 1, 0, 0], bool)))
    assert some.set_index("quantity")["mean"]["K"] == 0.5
    assert set(some.vertices) == set(some.undefined) == {1}
    # An estimator that has a value at the boundary is not measured there.
    exact.boundary[4] = True
    inside = pd.DataFrame(error_rows(exact, estimate, np.ones(5, bool)))
    assert inside.set_index("quantity")["mean"]["K"] == 0.25
    assert set(inside.vertices) == {2}
    assert set(inside.undefined) == {3}


def test_a_quantity_without_a_value_counts_its_vertices_as_undefined():
    exact = SimpleNamespace(K=np.ones(3), H=np.ones(3), boundary=np.zeros(3, bool))
    estimate = SimpleNamespace(K=np.ones(3), H=np.full(3, np.nan), returned=("K", "H"))
    H = pd.DataFrame(error_rows(exact, estimate, np.array([1, 1, 0], bool))).iloc[1]
    assert (H.quantity, H.vertices, H.undefined) == ("H", 0, 2)
    assert H[list(NORMS)].isna().all()


def test_vertices_without_poles():
    m = curvlib.tessellate(curvlib.surface("sphere"), 8)
    left_out = ~counted_vertices(m)["without-poles"]
    assert left_out.sum() == 2 * (1 + 8)
    assert np.abs(m.vertices[left_out, 2]).min() > 0.9
    cylinder = curvlib.tessellate(curvlib.surface("cylinder"), 8)
    assert list(counted_vertices(cylinder)) == ["interior"]


@pytest.mark.parametrize(
    ("values", "slope", "verdict"),
    [
        ([4, 1, 0.25], -2, "converges"),
        ([2, 1, 0.5], -1, "converges"),
        ([1, 1, 1], 0, "stagnates"),
        ([1, 2, 4], 1, "diverges"),
        ([1e-12, 1e-11, 1e-10], np.nan, "exact"),
        ([1e-15, 1, 0.25], -2, "converges"),
        ([np.nan, 1, 0.25], -2, "converges"),
        ([np.nan, 1e-15, 1e-12], np.nan, "exact"),
    ],
)
def test_slopes_and_verdicts(values, slope, verdict):
    row = curve(values)
    assert row.slope == pytest.approx(slope, abs=1e-12, nan_ok=True)
    assert row.verdict == verdict
    assert row.monotone != bool((np.diff(values) >= 0).any())


def test_what_first_falls_and_then_stays_stagnates():
    row = curve([8, 4, 2, 1, 1, 1], (8, 16, 32, 64, 128, 256))
    assert row.slope < -0.5
    assert row.tail == pytest.approx(0)
    assert row.verdict == "stagnates"


def test_standard_error_and_jackknife_are_those_of_the_textbook():
    x = np.log([8, 16, 32, 64])
    y = -2 * x + [0.1, -0.1, 0.05, -0.05]
    row = curve(np.exp(y), (8, 16, 32, 64))
    (slope, _), covariance = np.polyfit(x, y, 1, cov=True)
    assert row.slope == pytest.approx(slope)
    assert row.stderr == pytest.approx(np.sqrt(covariance[0, 0]))
    without = [np.polyfit(np.delete(x, i), np.delete(y, i), 1)[0] for i in range(4)]
    spread = np.sqrt(3 / 4 * np.sum((without - np.mean(without)) ** 2))
    assert row.jackknife == pytest.approx(spread)


def test_local_orders_and_their_range():
    """log(e1 / e2) / log(n2 / n1) by hand over the finest half; two points have no range."""
    row = curve([9, 9, 9, 8, 2, 1], (8, 16, 32, 64, 128, 256))
    assert (row.order, row.order_low, row.order_high) == pytest.approx((1.5, 1, 2))
    odd = curve([3, 2, 0.5], (12, 24, 50))
    local = np.log(3 / 2) / np.log(2), np.log(4) / np.log(50 / 24)
    assert (odd.order_low, odd.order_high) == pytest.approx(local)
    assert odd.order == pytest.approx(np.log(6) / np.log(50 / 12))
    for values in ([2, 1], [np.nan, 2, 1], [1e-15, 2, 1], [1e-15, 1e-12, 1e-15]):
        few = curve(values, (8, 16, 32)[: len(values)])
        assert np.isnan([few.order, few.order_low, few.order_high]).all()
    # What is at rounding between two points is left out.
    gap = curve([1e-15, 4, 1e-15, 1, 0.5], (8, 16, 32, 64, 128))
    assert (gap.order_low, gap.order_high) == pytest.approx((1, 1))


def test_a_slope_that_is_not_defined_is_no_divergence():
    values = np.array([[np.nan, np.nan], [4.0, 1.0], [1.0, 4.0], [np.nan, 4.0]])
    slopes = np.array([np.nan, -2.0, 2.0, np.nan])
    use = np.array([[0, 0], [1, 1], [1, 1], [1, 1]], dtype=bool)
    named = accuracy.verdicts(slopes, values, use)
    assert named == ["undefined", "converges", "diverges", "undefined"]


def rings(values):
    """Rows of the trials with rings of one kind, one mean error for each size."""
    key = {"valence": 6, "ring": "regular", "quantity": "K", "estimator": "e", "variant": "-"}
    h = 0.5 ** np.arange(1, len(values) + 1)
    return pd.DataFrame([key | {"h": x, "value": y} for x, y in zip(h, values)])


@pytest.mark.parametrize(
    ("values", "slope", "verdict"),
    [
        ([9, 9, 1 / 8**2, 1 / 16**2], -2, "converges"),
        ([9, 9, 1e-12, 0], np.nan, "exact"),
        ([9, 9, 9, 9, 1e-11, 1 / 64, 1 / 128, 1 / 256], -1, "converges"),
        ([9, 9, np.nan, np.nan], np.nan, "undefined"),
    ],
)
def test_slopes_on_rings_leave_out_rounding(values, slope, verdict):
    (row,) = accuracy.ring_slopes(rings(values)).itertuples()
    assert row.slope == pytest.approx(slope, nan_ok=True)
    assert row.verdict == verdict


def test_trials_without_a_ring_have_no_slopes():
    """As of an estimator of whole meshes: a table that is nothing but its header."""
    header = rings([1]).iloc[:0].astype(object)
    assert accuracy.ring_slopes(header).empty
    one = accuracy.concat([header, rings([4, 2, 1, 0.5])])
    assert one.value.dtype == float
    assert len(accuracy.ring_slopes(one)) == 1


def test_ties_at_rounding_level_share_a_rank():
    values = {"a": 1e-14, "b": 3e-10, "c": 0.5, "d": 0.5 * (1 + 1e-12), "e": 0.6, "f": np.nan}
    readings = pd.concat(READINGS.assign(estimator=e) for e in values)
    full = [MeshKey("s", "same", 8)]
    tables = (run_rows([x], (8,), estimator=e) for e, x in values.items())
    rows = accuracy.by_variant(tables, readings, full, full)
    ranks = accuracy.ranks(accuracy.errors(rows, readings), rows).set_index("estimator")["rank"]
    assert ranks.to_dict() == {"a": 1, "b": 1, "c": 3, "d": 3, "e": 5}


def test_an_estimator_that_leaves_vertices_out_has_no_rank():
    tables = [
        run_rows([x], (8,), estimator=e, vertices=v)
        for e, x, v in (("a", 3, 9), ("b", 2, 9), ("c", 1, 8))
    ]
    readings = pd.concat(READINGS.assign(estimator=e) for e in "abc")
    full = [MeshKey("s", "same", 8)]
    rows = accuracy.by_variant(tables, readings, full, full)
    ranks = accuracy.ranks(accuracy.errors(rows, readings), rows).set_index("estimator")["rank"]
    assert ranks.to_dict() == {"b": 1, "a": 2}


def test_a_row_in_two_tables_counts_once():
    one = run_rows([4, 2, 1])
    assert len(accuracy.concat([one, one.iloc[:2]])) == 3


def test_readings_share_variants():
    """A reading has the rows of the variants that it names; without poles counts the same where
    there are none; on meshes that are not full, and in slopes, it has those only if it is one
    of `more`."""
    tables = [
        run_rows([4, 2, 1], estimator="a"),
        run_rows([3, 2, 1], estimator="b"),
        run_rows([9, 9], (8, 16), estimator="b", variant="x"),
    ]
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
    full = [MeshKey("s", "same", 8), MeshKey("s", "same", 16)]
    rows = accuracy.by_variant(tables, readings, full, full[:1])
    assert rows.paper.tolist() == (rows.n == 8).tolist()
    table = accuracy.errors(rows, readings)
    assert list(table.norm[: len(NORMS)]) == sorted(NORMS)
    value = table[table.norm == "mean"].set_index(["reading", "estimator", "n"]).value.sort_index()
    assert value["default", "a"].tolist() == [4, 2, 1]
    assert value["other", "a"].tolist() == [4, 2]
    assert value["other", "b"].tolist() == [9, 9]
    curves = accuracy.curves(rows, readings)
    assert sorted(curves.finest[curves.estimator == "a"]) == [16, 16, 32]
    curves = accuracy.convergence(curves, readings).set_index(["estimator", "reading"])
    assert curves.finest["a"].to_dict() == {"default": 32, "other": 16}
    assert curves.finest["b", "other"] == 16
    assert curves.slope["b", "other"] == 0
