"""Figures: what is drawn, and the same bytes each time."""

import itertools
import subprocess
import sys
from types import SimpleNamespace

import matplotlib
import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from curvlib.comparison.quantities import QUANTITIES
from curvlib.comparison.throughput import LIMITS
from curvlib.figures.curves import error_plot, rank_plot
from curvlib.figures.rings import rings_plot
from curvlib.figures.style import save
from curvlib.figures.throughput import throughput_plot

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
    (axes,) = error_plot(*tables, "sphere", "K", MODULES).axes
    lines = {line.get_label(): line.get_ydata() for line in axes.lines}
    assert set(lines) == {"Flat", "Falling", "Exact (exact)", "O(h²)"}
    np.testing.assert_allclose(lines["Flat"], 0.5)
    exact = lines["Exact (exact)"]
    np.testing.assert_allclose(exact[~np.isnan(exact)], axes.get_ylim()[0])
    assert np.isfinite(exact).sum() == 7
    shown = [t.get_text() for t in axes.get_legend().texts]
    assert shown == ["Exact (exact)", "Falling", "Flat", "O(h²)"]
    assert axes.get_xscale() == axes.get_yscale() == "log"
    labels = [t.get_text() for t in axes.get_xticklabels()]
    assert labels[0] == "128"
    assert labels[-1] == "131072"


def test_no_line_leads_to_what_is_rounding(tables):
    errors, convergence = tables
    errors.loc[(errors.estimator == "falling") & (errors.n > 40), "value"] = 1e-12
    (axes,) = error_plot(errors, convergence, "sphere", "K", MODULES).axes
    (x, y), *_ = (line.get_data() for line in axes.lines if line.get_label() == "Falling")
    np.testing.assert_allclose(y[:5], [n**-2.0 for n in (8, 12, 16, 24, 32)])
    assert np.isnan(y[[5, 7]]).all(), "a gap before each point on the edge"
    np.testing.assert_allclose(y[[6, 8]], axes.get_ylim()[0])
    np.testing.assert_array_equal(x[[6, 8]], [5000, 131072])


def test_the_guide_is_as_steep_as_second_order(tables):
    (axes,) = error_plot(*tables, "sphere", "K", MODULES).axes
    [((x0, y0), (x1, y1))] = [g.get_xydata() for g in axes.lines if g.get_label() == "O(h²)"]
    assert np.log(y1 / y0) / np.log(x1 / x0) == pytest.approx(-1), "-2 in n"
    assert not texts(axes), "no name on a curve"


def test_error_plot_is_legible_in_print(tables, printed):
    printed(error_plot(*tables, "sphere", "K", MODULES))


def test_errors_within_a_decade_have_labels(tables, printed):
    errors, convergence = tables
    errors = errors[errors.estimator == "flat"].assign(value=np.linspace(0.3, 0.9, 7))
    figure = error_plot(errors, convergence, "sphere", "K", MODULES)
    printed(figure)
    (axes,) = figure.axes
    low, high = axes.get_ylim()
    shown = [t.get_text() for t in axes.get_yticklabels() if low <= t.get_position()[1] <= high]
    assert shown == ["0.2", "0.5", "1"][: len(shown)]
    assert len(shown) >= 2


@pytest.mark.parametrize("kind", ["svg", "png"])
def test_the_same_bytes_each_time(tables, tmp_path, kind):
    made = []
    for name in "ab":
        path = tmp_path / f"{name}.{kind}"
        save(error_plot(*tables, "sphere", "K", MODULES), path)
        made.append(path.read_bytes())
    assert made[0] == made[1]


def test_nobody_else_s_matplotlib_changes(tables, tmp_path):
    """Neither an import of the figures nor what they draw leaves a setting behind."""
    code = (
        "import matplotlib; before = dict(matplotlib.rcParams)\n"
        "import curvlib.figures.pictures, curvlib.figures.marginals, curvlib.figures.throughput\n"
        "print({k: v for k, v in matplotlib.rcParams.items() if v != before[k]})"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "{}"
    before = dict(matplotlib.rcParams)
    figure = error_plot(*tables, "sphere", "K", MODULES)
    assert not figure.axes[0].spines["top"].get_visible()
    assert not figure.axes[0].get_legend().get_frame_on()
    save(figure, tmp_path / "a.svg")
    assert dict(matplotlib.rcParams) == before


def test_what_cannot_be_drawn_leaves_no_file(tmp_path):
    figure = Figure()
    figure.text(0.5, 0.5, r"$\nothing$")
    with pytest.raises(ValueError, match="nothing"):
        save(figure, tmp_path / "a.png")
    assert list(tmp_path.iterdir()) == []


def test_limits_of_throughput_are_dashed_and_grey(printed):
    methods = ["falling", *LIMITS, "peer"]
    table = pd.DataFrame(
        {"mesh": "regular", "method": m, "threads": 1, "vertices": n, "seconds": 1.0}
        | {"vertices_per_second": n}
        for m in methods
        for n in (100, 1000)
    )
    figure = throughput_plot(table, {"falling": MODULES["falling"]})
    printed(figure)
    (axes,) = figure.axes
    drawn = {line.get_label(): line for line in axes.lines}
    assert list(drawn) == ["Falling", *LIMITS, "peer"]
    grey = {label for label, line in drawn.items() if line.get_color() == "0.5"}
    assert grey == set(LIMITS)
    assert len({drawn[limit].get_linestyle() for limit in LIMITS} - {"-"}) == len(LIMITS)


def texts(axes):
    return [text.get_text() for text in axes.texts]


def contrast(colour):
    """Of a colour against white, as WCAG 2 defines it."""
    rgb = np.array(to_rgb(colour))
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    return 1.05 / (linear @ [0.2126, 0.7152, 0.0722] + 0.05)


def test_rank_plot_is_of_the_resolution_asked_for(printed):
    places = {(50, "flat"): (1, 2), (50, "falling"): (1, 1), (256, "flat"): (2, 1)}
    ranks = pd.DataFrame(
        {"surface": s, "diagonal": "same", "reading": "default", "quantity": "K", "n": n}
        | {"estimator": e, "rank": rank}
        for (n, e), both in places.items()
        for s, rank in zip(("sphere", "exact"), both)
    )
    figure = rank_plot(ranks, "K", ["sphere", "exact"], MODULES, 50)
    (axes,) = figure.axes
    printed(figure)
    assert axes.get_title(loc="left").endswith("n = 50")
    marked = {line.get_label(): line for line in axes.lines if line.get_marker() == "o"}
    assert [marked[m].get_ydata().tolist() for m in ("Flat", "Falling")] == [[1, 2], [1, 1]]
    assert marked["Flat"].get_xdata()[0] > marked["Falling"].get_xdata()[0], "side by side"
    between = [line.get_linewidth() for line in axes.lines if line.get_linestyle() != "None"]
    assert len(between) == 2
    assert max(between) < 1


def test_rank_plot_leaves_out_estimators_without_a_rank(printed):
    ranks = pd.DataFrame(
        {"surface": s, "diagonal": "same", "reading": "default", "quantity": "K", "n": 50}
        | {"estimator": e, "rank": rank}
        for e, both in {"flat": (1, np.nan), "falling": (np.nan, np.nan)}.items()
        for s, rank in zip(("sphere", "exact"), both)
    )
    figure = rank_plot(ranks, "K", ["sphere", "exact"], MODULES, 50)
    printed(figure)
    (axes,) = figure.axes
    marked = {line.get_label(): line for line in axes.lines if line.get_marker() == "o"}
    assert [line.get_xydata().tolist() for line in marked.values()] == [[[0, 1]]]
    nothing = rank_plot(ranks.assign(rank=np.nan), "K", ["sphere", "exact"], MODULES, 50)
    assert not nothing.axes[0].lines


VARIANTS = [("flat", "-", "Flat"), ("falling", "normal=exact", "Falling")]


@pytest.fixture
def rings():
    """Errors on rings, and their orders: a third of the valence where they fall."""
    rows, slopes = [], []
    for (name, variant, _), n, ring, quantity in itertools.product(
        VARIANTS, range(3, 10), ("regular", "irregular"), QUANTITIES
    ):
        order = n / 3 if name == "falling" and ring == "regular" else -0.001
        key = {"estimator": name, "variant": variant, "valence": n, "ring": ring}
        key |= {"quantity": quantity}
        rows += [key | {"h": h, "value": 0.1 * h**order} for h in (0.125, 0.5, 0.25)]
        slopes.append(key | {"slope": -order})
    return pd.DataFrame(rows), pd.DataFrame(slopes)


def test_rings_plot_has_the_order_at_the_end_of_every_line(rings, printed):
    figure = rings_plot(*rings, VARIANTS, "K")
    panels = dict(zip(itertools.product(("regular", "irregular"), VARIANTS), figure.axes))
    assert [axes.get_title(loc="left") for axes in figure.axes] == ["Flat", "Falling", "", ""]
    for (kind, (estimator, *_)), axes in panels.items():
        assert len(axes.lines) == 7
        falls = kind == "regular" and estimator == "falling"
        labels = [f"{n}: {n / 3 if falls else 0:.1f}" for n in range(3, 10)]
        assert [line.get_label() for line in axes.lines] == labels
        assert sorted(texts(axes)) == [*labels, "valence: p"]
        label = {t.get_text(): t for t in axes.texts}
        heights = sorted(label[name].xyann[1] for name in labels)
        assert np.diff(heights).min() > 0.07, "no label on another"
        for line in axes.lines:
            np.testing.assert_array_equal(line.get_xdata(), [0.5, 0.25, 0.125])
            at_end = label[line.get_label()]
            assert (at_end.get_color() == line.get_color()).all()
            end = axes.transData.transform(line.get_xydata()[-1])
            np.testing.assert_allclose(axes.transAxes.transform(at_end.xy), end)
            assert at_end.xy[0] > 0.9, "small rings are on the right"
    printed(figure)
    assert min(contrast(line.get_color()) for line in figure.axes[0].lines) >= 3


@pytest.mark.parametrize("quantity", QUANTITIES)
def test_rings_plot_says_what_its_error_is(rings, quantity):
    figure = rings_plot(*rings, VARIANTS, quantity)
    error = figure.texts[-1].get_text()
    unit = QUANTITIES[quantity].unit
    assert error == rf"mean of $|{quantity} - {quantity}_\mathrm{{est}}|$ ({unit})"


def test_rings_plot_of_a_study_without_those_estimators(rings):
    figure = rings_plot(*rings, [], "K")
    assert [text.get_text() for text in figure.texts] == ["not in this study"]
    variants = [VARIANTS[0], ("falling", "normal=area", "Not run")]
    one, other, *_ = rings_plot(*rings, variants, "K").axes
    assert len(texts(one)) == 8
    assert texts(other) == ["not in this study"]
    assert len(rings_plot(*rings, VARIANTS[:1], "K").axes) == 2
