"""Figures: what is drawn, and the same bytes each time."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from curvlib import claim_figures, figures

MODULES = {
    name: SimpleNamespace(LABEL=name.title(), STYLE={"color": "black", "marker": "o"})
    for name in ("flat", "falling", "exact", "sphere")
}


@pytest.fixture
def tables():
    n = np.array([8, 12, 16, 24, 32, 50, 256])
    first = {"surface": "sphere", "diagonal": "same", "reading": "default", "quantity": "K"}
    curves = {"flat": np.full(7, 0.5), "falling": n**-2.0, "exact": np.full(7, 1e-15)}
    errors = pd.DataFrame(
        first | {"estimator": e, "norm": "mean", "n": m, "triangles": 2 * m * m, "value": x}
        for e, values in curves.items()
        for m, x in zip(n, values)
    )
    verdicts = {"flat": "stagnates", "falling": "converges", "exact": "exact"}
    convergence = pd.DataFrame(
        first | {"estimator": e, "verdict": v, "rounding": 1e-9} for e, v in verdicts.items()
    )
    return errors, convergence


def test_error_plot_shows_every_curve_and_what_is_exact(tables):
    (axes,) = figures.error_plot(*tables, "sphere", "K", MODULES).axes
    lines = {line.get_label(): line.get_ydata() for line in axes.lines}
    assert set(lines) == {"Flat", "Falling", "Exact (exact)"}
    np.testing.assert_allclose(lines["Flat"], 0.5)
    np.testing.assert_allclose(lines["Exact (exact)"], axes.get_ylim()[0])
    assert axes.get_xscale() == axes.get_yscale() == "log"
    labels = [t.get_text() for t in axes.get_xticklabels()]
    assert labels[0] == "128"
    assert labels[-1] == "131072"


@pytest.mark.parametrize("kind", ["svg", "png"])
def test_the_same_bytes_each_time(tables, tmp_path, kind):
    made = []
    for name in "ab":
        path = tmp_path / f"{name}.{kind}"
        figures.save(figures.error_plot(*tables, "sphere", "K", MODULES), path)
        made.append(path.read_bytes())
    assert made[0] == made[1]


def test_specification_curve_has_a_point_and_its_choices_per_reading():
    readings = {"a=1": {"a": 1}, "a=2": {"a": 2}}
    claims = pd.DataFrame(
        {"claim": 1, "surface": s, "diagonal": "same", "reading": r, "holds": h, "effect": x}
        for r, h, x in (("a=1", "false", 3.0), ("a=2", "true", 0.5))
        for s in ("sphere", "cone")
    )
    claim = SimpleNamespace(claim=1, sentence="It holds.", measure="a ratio")
    figure = claim_figures.specification_curve(claims, readings, claim, ["sphere", "cone"])
    above, below = figure.axes
    drawn = {c.get_label(): c.get_offsets().tolist() for c in above.collections}
    assert drawn["true"] == [[0, 0.5]], "sorted by effect"
    assert drawn["false"] == [[1, 3.0]]
    labels = [t.get_text() for t in below.get_yticklabels()]
    assert labels == ["cut: same", "a: 1", "a: 2"]
