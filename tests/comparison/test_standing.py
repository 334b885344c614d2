"""Ranks and ratios to the best, by hand, and the figure of them."""

import numpy as np
import pandas as pd
import pytest

from curvlib.comparison.standing import beside_best, ranked, standing
from curvlib.figures.standing import MINE, standing_plot


@pytest.fixture
def table():
    """Estimators a, b and c, the last without H, on two surfaces; at the boundary only a and b."""
    errors = {
        ("ball", "interior", "K"): (1.0, 2.0, 8.0),
        ("tube", "interior", "K"): (8.0, 1.0, 2.0),
        ("ball", "interior", "H"): (3.0, 3.0, np.nan),
        ("tube", "interior", "H"): (1.0, 3.0, np.nan),
        ("tube", "boundary", "K"): (5.0, 4.0, np.nan),
    }
    rows = [
        [name, *place, n, value * 100 / n]
        for place, values in errors.items()
        for name, value in zip("abc", values)
        for n in (10, 20)
    ]
    columns = ["estimator", "surface", "place", "quantity", "n", "value"]
    return ranked(pd.DataFrame(rows, columns=columns))


def test_ranks(table):
    finest = table[table.n == 20].set_index(["surface", "place", "quantity", "estimator"])
    finest = finest["rank"].sort_index()
    assert finest["ball", "interior", "K"].tolist() == [1, 2, 3]
    assert finest["ball", "interior", "H"].tolist()[:2] == [1, 1]
    assert np.isnan(finest["tube", "boundary", "K", "c"])


def test_rows_beside_the_best(table):
    rows = {(r["surface"], r["place"], r["quantity"]): r for r in beside_best(table, "a")}
    assert len(rows) == 5
    row = rows["tube", "interior", "K"]
    assert (row["value"], row["rank"], row["of"]) == (40, 3, 3)
    assert (row["best"], row["best_value"], row["n"]) == ("b", 5, 20)
    assert rows["tube", "boundary", "K"]["of"] == 2


def test_standing(table):
    found = standing(table)
    assert list(found.index) == ["b", "a", "c"]
    np.testing.assert_allclose(found.K, [np.sqrt(2), np.sqrt(8), np.sqrt(16)])
    np.testing.assert_allclose(found.H, [np.sqrt(3), 1, np.nan])


def test_the_figure_has_every_estimator_in_each_panel(table):
    figure = standing_plot(table, "c")
    panels = figure.axes
    assert len(panels) == 6
    ball, tube, _, H, *_ = panels
    assert len(ball.lines) == 3
    (own,) = [line for line in ball.lines if line.get_color() == MINE]
    np.testing.assert_allclose(own.get_ydata(), [80, 40])
    assert [text.get_text() for text in tube.texts] == ["best: b"]
    assert "c: no value" in [text.get_text() for text in H.texts]
