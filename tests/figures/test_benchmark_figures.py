"""Figures of the benchmark: what their marks show, from tables made up so that it is known."""

import numpy as np
import pandas as pd
import pytest

from curvlib.figures.benchmark import against_cost, against_n, matrix, under_noise

LABELS = {"irregular": "Clean irregular meshes", "voxels": "Voxels"}


@pytest.fixture
def situations():
    rows = [
        ("irregular", "adaptive_fit", 1.0, 1),
        ("irregular", "jet", 4.0, 2),
        ("irregular", "slow", 9.0, 3),
        ("voxels", "adaptive_fit", 2.0, 2),
        ("voxels", "jet", np.nan, np.nan),
        ("voxels", "slow", 1.0, 1),
    ]
    table = pd.DataFrame(rows, columns=["situation", "estimator", "over_best", "rank"])
    return pd.concat([table.assign(quantity=q) for q in ("K", "H")], ignore_index=True)


def texts(axes):
    return [text.get_text() for text in axes.texts]


def test_the_matrix_has_ranks_where_there_are_some_the_best_on_top(situations):
    axes = matrix(situations, LABELS).axes[0]
    assert [label.get_text() for label in axes.get_yticklabels()] == ["adaptive_fit", "slow", "jet"]
    at = {
        (round(t.get_position()[0] - 0.5), round(t.get_position()[1] - 0.5)): t.get_text()
        for t in axes.texts
    }
    assert at == {(0, 0): "1", (1, 0): "2", (0, 1): "3", (1, 1): "1", (0, 2): "2"}


def test_the_front_is_of_those_that_nobody_beats_in_both(situations):
    cost = pd.DataFrame(
        {"estimator": ["jet", "slow", "adaptive_fit"], "microseconds": [1.0, 90.0, 30.0]}
    )
    clean, voxels = against_cost(situations, cost, LABELS, "H").axes[:2]
    front = clean.lines[1].get_xydata()
    np.testing.assert_allclose(front, [[1, 4], [30, 1]])
    assert texts(clean) == ["a", "b", "a  jet\nb  adaptive_fit"]
    np.testing.assert_allclose(voxels.lines[1].get_xydata(), [[30, 2], [90, 1]])


def errors(**values):
    rows = []
    for name, errors in values.items():
        for n, surfaces in zip((16, 32), errors):
            for surface, error in zip("ab", surfaces):
                for quantity in ("K", "H"):
                    row = {"estimator": name, "surface": surface, "scaled": error, "n": n}
                    rows.append(row | {"quantity": quantity, "level": n / 1000})
    table = pd.DataFrame(rows).assign(norm="mean", place="interior", vertices=100, undefined=0)
    return table.assign(family="jittered", noise="none")


def test_curves_are_geometric_means_and_name_the_best_and_the_default():
    table = errors(jet=[(1e-2, 4e-2), (1e-3, 1e-3)], adaptive_fit=[(1e-1, 1e-1), (1e-2, 1e-2)])
    figure = against_n(table, ["jittered"], {"jittered": "Jittered"})
    axes = figure.axes[0]
    assert axes.get_title(loc="left") == "Jittered"
    curves = [line.get_ydata() for line in axes.lines if len(line.get_ydata())]
    assert any(np.allclose(y, [2e-2, 1e-3]) for y in curves)
    named = [text.get_text() for text in figure.legends[0].get_texts()]
    assert named == ["adaptive_fit", "jet"]
    noise = under_noise(table.assign(noise="white"), ["white"]).axes[0]
    assert any(np.allclose(line.get_xdata(), [0.016, 0.032]) for line in noise.lines)


def test_who_has_no_value_on_a_surface_is_not_drawn_there():
    part = errors(jet=[(1e-2, 4e-2), (1e-3, 1e-3)], half=[(1e-9,), (1e-9,)])
    axes = against_n(part, ["jittered"], {}).axes[0]
    assert min(min(line.get_ydata()) for line in axes.lines if len(line.get_ydata())) > 9e-4
