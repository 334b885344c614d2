"""The survey of estimators: its numbers, worked out by hand; its page."""

import numpy as np
import pandas as pd
import pytest

import curvlib
from curvlib.catalogue import estimators
from curvlib.comparison.calls import FURTHER, Call, calls
from curvlib.comparison.survey import KEY, survey
from curvlib.comparison.survey_page import SURFACES as TITLED
from curvlib.comparison.survey_page import page
from curvlib.meshes.jittered import SURFACES, jittered
from curvlib.signatures import readings

MINE = '''
"""K and H of a sphere of radius 2, wherever the mesh bends."""

LABEL = "Mine"


def estimate(disk):
    """Notes
    -----
    Order: none; a constant
    has none.

    Source: here.
    """
    return 0.25, 0.5
'''


@pytest.fixture
def mine(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(MINE)
    return str(path)


@pytest.fixture(scope="module")
def table():
    return survey(["gauss_bonnet", "jet"], 1, (9, 12), (0, 1))


def test_calls():
    found = calls(["taubin", "jet"])
    assert found == [Call("taubin", {}), Call("jet", {}), *(Call("jet", o) for o in FURTHER["jet"])]
    assert str(Call("jet", {"degree": 4, "rings": 3})) == "jet(degree=4, rings=3)"
    assert str(Call("folder/mine.py", {})) == "mine"
    assert [call.neighbourhood for call in found[:2]] == ["1 ring", "2 rings"]
    assert Call("quadric", {"radius": "5 edges"}).neighbourhood == "radius 5 edges"
    assert Call(lambda mesh: mesh, {}).neighbourhood == "mesh"

    def two_passes(disk, field, rings=2):
        return field

    two_passes.__globals__["field"] = lambda disk: (0.0,)
    assert Call(two_passes, {}).neighbourhood == "2 rings, twice"


def test_every_further_call_is_one():
    for name, options in FURTHER.items():
        for chosen in options:
            known = readings(name)
            assert all(value in known[option] for option, value in chosen.items())
            assert chosen not in ({}, {option: known[option][0] for option in chosen})


def test_rows(table):
    assert list(table.columns) == [*KEY, "n", "value", "defined", "order"]
    assert set(table.estimator) == {str(call) for call in calls(["gauss_bonnet", "jet"])}
    assert set(table.quantity[table.estimator == "gauss_bonnet"]) == {"K", "H"}
    assert set(table.quantity[table.estimator == "jet"]) == {"K", "H", "k1", "k2", "d1"}
    places = table.groupby("surface").place.unique().map(sorted).to_dict()
    closed = ["interior"]
    assert places == {"torus": closed, "ellipsoid": closed, "patch": ["boundary", "interior"]}
    found = table.set_index([*KEY, "n"]).sort_index()
    meshes = [jittered("patch", 12, seed) for seed in (0, 1)]
    errors = [curvlib.estimate(m, "jet").k2 - m.k2 for m in meshes]
    for place, part in (("interior", False), ("boundary", True)):
        expected = np.concatenate([abs(e)[m.boundary == part] for e, m in zip(errors, meshes)])
        row = found.loc[("jet", "patch", place, "k2", 12)]
        assert row.value == pytest.approx(expected.mean())
        assert row.defined == 1
        before = found.loc[("jet", "patch", place, "k2", 9)]
        assert np.isnan(before.order)
        assert row.order == pytest.approx(np.log(before.value / row.value) / np.log(12 / 9))
    edge = table[(table.estimator == "gauss_bonnet") & (table.place == "boundary")]
    assert (edge.defined == 0).all()
    assert edge.value.isna().all()


def test_a_strangers_file_joins(mine):
    table = survey(["taubin", mine], 2, (9, 12), (0,))
    rows = table[(table.estimator == "mine") & (table.surface == "torus") & (table.n == 12)]
    m = jittered("torus", 12)
    expected = {"K": abs(m.K - 0.25).mean(), "H": abs(m.H - 0.5).mean()}
    assert rows.set_index("quantity").value.to_dict() == pytest.approx(expected)
    text = page(table, ["taubin", mine])
    assert "* `mine`: none; a constant has none.\n" in text
    assert "| mine | 1 ring |" in text
    assert text.count("| mine |") == len(SURFACES) + 2


def test_values_do_not_depend_on_threads(table):
    pd.testing.assert_frame_equal(survey(["gauss_bonnet", "jet"], 2, (9, 12), (0, 1)), table)


def test_the_page_ranks_by_K_and_shows_error_and_order(table):
    text = page(table, ["gauss_bonnet", "jet"])
    assert set(TITLED) == set(SURFACES)
    torus = text[text.index("## Torus") : text.index("## Ellipsoid")]
    lines = [line.strip("| ").split(" | ") for line in torus.splitlines() if line.startswith("| ")]
    assert lines[0] == ["estimator", "K", "H", "k1", "k2", "d1"]
    inside = table[(table.surface == "torus") & (table.quantity == "K")].set_index("estimator")
    coarse, fine = (inside[inside.n == n] for n in (9, 12))
    assert [line[0] for line in lines[2:]] == list(coarse.value.sort_values().index)
    for name, shown, *_ in lines[2:]:
        value, order = shown.rstrip(")").split(" (")
        assert float(value) == pytest.approx(coarse.value[name], rel=0.06)
        assert float(order) == pytest.approx(fine.order[name], abs=0.051)
    edge = text[text.index("## At the boundary") :]
    assert "| gauss_bonnet | 0 % |" in edge
    assert "| jet | 100 % |" in edge
    assert "µs" not in text


def test_the_page_joins_the_cost(table):
    method = ["jet", "jet(degree=3)", "libigl gaussian_curvature", "jet", "jet", "jet"]
    cost = pd.DataFrame({"method": method, "seconds": [2.0, 3, 1, 9, 9, 9]})
    cost["mesh"] = ["irregular"] * 3 + ["regular", "irregular", "irregular"]
    cost["vertices"] = [1_000_000] * 4 + [10_000, 1_000_000]
    cost["threads"] = [1] * 5 + [2]
    cost["ratio"] = [8.0, 12, 1, 7, 7, 7]
    text = page(table, ["gauss_bonnet", "jet"], cost)
    assert "| estimator | neighbourhood | µs a vertex | ratio |" in text
    assert "| jet | 2 rings | 2 | 8 |" in text
    assert "| jet(degree=3) | 2 rings | 3 | 12 |" in text
    assert "| gauss_bonnet | 1 ring |  |  |" in text


def test_every_estimator_of_the_folder_has_an_order_on_the_page(table):
    names = estimators.names()
    known = page(table, names).partition("## Orders")[2]
    assert all(f"* `{name}`: " in known for name in names)
