"""Figures of the article on later estimators: what is drawn where."""

import numpy as np
import pandas as pd
import pytest

from curvlib.comparison.frontier import REFERENCE
from curvlib.figures import fits

ROWS = {"kind": "jittered", "place": "interior", "quantity": "K", "held_out": True}


def test_noise_plot_has_the_envelope_of_fixed_fits():
    levels = (0.0, 1e-4, 0.05)
    values = {"a": (1.0, 2.0, 9.0), "b": (3.0, 3.0, 3.0), "adaptive_fit": (1.1, 2.2, 3.3)}
    table = pd.DataFrame(
        {"surface": "ring", "noise": noise, "level": level, "fit": fit, "quantity": q, "value": x}
        for noise in ("white", "half")
        for q in ("K", "H")
        for fit, row in values.items()
        for level, x in zip(levels, row)
    )
    panels = fits.noise_plot(table).axes
    assert [axes.get_title(loc="left") for axes in panels] == ["ring", ""]
    for axes in panels:
        *others, envelope, chosen = (line.get_ydata() for line in axes.lines)
        assert len(others) == 2, "white noise alone"
        np.testing.assert_array_equal(envelope, (1, 2, 3))
        np.testing.assert_array_equal(chosen, (1.1, 2.2, 3.3))
    labels = [text.get_text() for text in panels[-1].get_xticklabels()]
    assert labels == ["0", "$10^{-4}$", "0.05"]


def test_order_plot_leaves_out_what_was_not_measured():
    table = pd.DataFrame(
        ROWS | {"surface": s, "estimator": e, "n": n, "value": n**-3.0}
        for s in ("pear", "bump")
        for e, sizes in ((REFERENCE, (10, 20, 40)), ("gauss_bonnet", (10, 20)))
        for n in sizes
    )
    left, right = fits.order_plot(table, ["pear", "bump"], "K").axes
    for axes in (left, right):
        found = {line.get_label(): line.get_xdata() for line in axes.lines}
        assert set(found) == {"CGAL's fit, degree 4", "angle defect"}
        assert found["angle defect"].tolist() == [10, 20]


def test_cost_plot_joins_what_nothing_beats():
    measured = {
        REFERENCE: (10.0, 1.0),
        "jet(degree=4)": (1.0, 0.5),
        "compact_hermite": (5.0, 0.01),
        "vtk_curvatures": (2.0, 90.0),
        "gauss_bonnet": (0.2, 80.0),
    }
    accuracy = pd.DataFrame(
        ROWS | {"surface": s, "estimator": e, "n": n, "ratio": ratio * f if n == 20 else 1e3}
        for e, (_, ratio) in measured.items()
        for n in (10, 20, 40)
        for s, f in (("pear", 2.0), ("bump", 0.5))
    )
    cost = pd.DataFrame({"method": e, "microseconds": x} for e, (x, _) in measured.items())
    peers = pd.DataFrame({"method": ["vtk_curvatures"], "label": ["VTK"], "installed": [True]})
    (axes,) = fits.cost_plot(accuracy, cost, peers).axes
    *points, front = axes.lines
    found = {p.get_label(): (p.get_xdata()[0], p.get_ydata()[0]) for p in points}
    assert found["3 VTK"] == pytest.approx((2.0, 90.0)), "the geometric mean at the second n"
    assert found["5 CGAL's fit, degree 4"] == pytest.approx((10.0, 1.0))
    np.testing.assert_allclose(front.get_xdata(), (0.2, 1.0, 5.0))
    np.testing.assert_allclose(front.get_ydata(), (80, 0.5, 0.01))


def test_ablation_plot_has_ratios():
    mesh = {"surface": "pear", "kind": "random", "quantity": "K"}
    jets = pd.DataFrame(
        mesh | {"degree": d, "rings": k, "change": c, "place": "interior", "value": x}
        for d, k in ((4, 2), (6, 3))
        for c, x in (("none", 2.0), ("centre=free", 3.0))
    )
    compact = pd.DataFrame(
        mesh | {"degree": 6, "change": change, "setting": setting, "value": x}
        for change, setting, x in (
            ("sweeps", 0, 40.0),
            ("sweeps", 16, 4.0),
            ("gain", 1e9, 8.0),
            ("slope", 0.03, 4.0),
        )
    )
    left, right = fits.ablation_plot(jets, compact).axes
    shown = [[t.get_text() for t in axes.get_yticklabels()] for axes in (left, right)]
    assert shown[0] == ["4: not through the vertex", "6: not through the vertex"]
    assert shown[1] == ["6: gain none", "6: sweeps 0"]
    ratios = [line.get_xdata()[0] for line in right.lines if len(line.get_xdata()) == 1]
    assert sorted(ratios) == [2, 10]


def test_where_plot_has_one_scale():
    table = pd.DataFrame(
        {"estimator": e, "x": x, "y": y, "error": error}
        for e, error in ((REFERENCE, 1e-2), ("compact_hermite", 1e-5))
        for x in (-1, 0, 1)
        for y in (-1, 1)
    )
    panels = [axes for axes in fits.where_plot(table).axes if axes.collections]
    limits = {drawn.get_clim() for axes in panels for drawn in axes.collections}
    titles = [axes.get_title(loc="left") for axes in panels if axes.get_title(loc="left")]
    assert titles == ["CGAL's fit, degree 4", "compact, degree 6"]
    assert len([x for x in limits if x == (-5, -2)]) == 1
