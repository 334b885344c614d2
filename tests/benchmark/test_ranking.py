"""Ranks and advice of the benchmark, from tables made up so that they are known."""

import numpy as np
import pandas as pd
import pytest

from curvlib.benchmark.advice import SITUATIONS, advice, situations
from curvlib.benchmark.errors import NORMS
from curvlib.benchmark.page import recommendation
from curvlib.benchmark.ranking import ranked


def table(values, family="jittered", undefined=None, norms=NORMS, **labels):
    """Errors: `values` maps an estimator to its scaled errors on meshes of two surfaces."""
    rows = []
    for name, errors in values.items():
        for k, error in enumerate(errors):
            row = {"surface": "ab"[k % 2], "family": family, "noise": "none", "level": 0.0, "n": k}
            row |= {"estimator": name, "place": "interior", "quantity": "K", "vertices": 100}
            row |= {"undefined": (undefined or {}).get(name, 0), "vertices_of_mesh": 100}
            row |= labels
            rows += [row | {"norm": norm, "value": error, "scaled": error} for norm in norms]
    return pd.DataFrame(rows)


def test_over_the_best_is_a_geometric_mean_over_meshes():
    errors = table({"good": [1e-3, 4e-3], "bad": [2e-3, 8e-3], "mixed": [8e-3, 2e-3]})
    found = ranked(errors, ["family", "quantity"]).set_index("estimator")
    assert found.over_best["good"] == pytest.approx(np.sqrt(1 * 2))
    assert found.over_best["bad"] == pytest.approx(np.sqrt(2 * 4))
    assert found.over_best["mixed"] == pytest.approx(np.sqrt(8 * 1))
    assert found["rank"].to_dict() == {"good": 1, "bad": 2, "mixed": 2}
    assert found.wins.to_dict() == {"good": 0.5, "bad": 0.0, "mixed": 0.5}
    # Without surface a, mixed is the best; without b it is the last.
    assert (found.rank_low["mixed"], found.rank_high["mixed"]) == (1, 3)


def test_norms_may_rank_otherwise():
    means = table({"steady": [2.0, 2.0], "wild": [1.0, 1.0]}, norms=["mean", "median"])
    worst = table({"steady": [3.0, 3.0], "wild": [90.0, 90.0]}, norms=["q95", "max"])
    found = ranked(pd.concat([means, worst]), ["quantity"]).set_index("estimator")
    assert found["rank"].to_dict() == {"wild": 1, "steady": 2}
    assert found.rank_max.to_dict() == {"wild": 2, "steady": 1}
    assert found.rank_high["wild"] == 2


def test_who_leaves_vertices_out_has_no_rank():
    errors = table({"all": [1.0, 1.0], "few": [0.1, 0.1]}, undefined={"few": 20})
    found = ranked(errors, ["quantity"]).set_index("estimator")
    assert found["rank"]["all"] == 1
    assert np.isnan(found["rank"]["few"])
    assert found.meshes["few"] == 0
    assert found.over_best["all"] == 1


def test_errors_below_a_millionth_are_equal():
    found = ranked(table({"a": [1e-16, 1e-3], "b": [1e-7, 1e-3]}), ["quantity"])
    assert found["rank"].tolist() == [1, 1]


def costs(**micro):
    rows = [{"estimator": k, "microseconds": v, "ratio": 2 * v} for k, v in micro.items()]
    return pd.DataFrame(rows)


def test_advice_names_the_best_its_margin_and_a_cheaper_one():
    errors = table({"best": [1.0, 1.0], "cheap": [1.5, 1.5], "adaptive_fit": [3.0, 3.0]})
    found = advice(situations(errors), costs(best=9.0, cheap=1.0, adaptive_fit=4.0))
    (row,) = found.to_dict("records")
    assert (row["situation"], row["quantity"], row["best"]) == ("irregular", "K", "best")
    assert row["margin"] == pytest.approx(1.5)
    assert (row["cheap"], row["cheap_microseconds"]) == ("cheap", 1.0)
    assert row["default_over"] == pytest.approx(3)
    text = recommendation(found)
    assert "for Gaussian curvature K `best` (9 µs), 1.5 times better than `cheap`" in text
    assert "`cheap` costs 1 µs and errs 1.5 times as much" in text
    assert "the best in 0 of 1 cases, within twice the best error in 0" in text


def test_other_libraries_are_not_advised_but_told():
    errors = table({"vtk_curvatures": [0.5, 0.5], "ours": [1.0, 1.0], "no_cost": [0.1, 0.1]})
    (row,) = advice(situations(errors), costs(ours=1.0, vtk_curvatures=1.0)).to_dict("records")
    assert (row["best"], row["peer"]) == ("ours", "vtk_curvatures")
    assert row["peer_over"] == pytest.approx(0.5)


def test_each_situation_has_meshes_of_its_own():
    clean = table({"e": [1.0]})
    noise = table({"e": [1.0]}, noise="white", level=0.01)
    outliers = table({"e": [1.0]}, noise="outliers", level=0.01)
    boundary = table({"e": [1.0]}, family="open", place="boundary")
    voxels = table({"e": [1.0]}, family="voxels")
    found = {
        kind: [s.name for s in SITUATIONS if s.rows(errors).any()]
        for kind, errors in (
            ("clean", clean),
            ("noise", noise),
            ("outliers", outliers),
            ("boundary", boundary),
            ("voxels", voxels),
        )
    }
    assert found == {
        "clean": ["irregular"],
        "noise": ["noise"],
        "outliers": ["outliers"],
        "boundary": ["boundary"],
        "voxels": ["voxels"],
    }
