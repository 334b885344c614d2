"""Errors and ranks of the estimators against resolution and surface."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter

from curvlib.comparison.quantities import QUANTITIES

from .style import SMALL, TEXT_WIDTH, in_lines, in_style

CURVE = {"markersize": 4, "linewidth": 1.1}


@in_style
def error_plot(errors, convergence, surface: str, quantity: str, modules) -> Figure:
    """Mean absolute error of a quantity against the number of triangles, as Figures 3 to 6.

    One curve per estimator in the default reading, log-log, at the resolutions in the table.
    `modules`: the module of every surface and estimator, by name, for label and style. An error
    at rounding level is a marker on the lower edge, without a line to it.
    """
    mean = errors[errors.norm == "mean"]
    points, curves = (t[_shown(t, [surface], quantity)] for t in (mean, convergence))
    level = curves.rounding.max() if len(curves) else 0.0
    visible = points.value[points.value > level]
    floor = visible.min() / 1.5 if len(visible) else level
    exact = set(curves.estimator[curves.verdict == "exact"])
    figure = Figure(figsize=(4.5, 2.7))
    # Fixed axes: matplotlib's layout engines take longer than the drawing.
    axes = figure.add_axes((0.15, 0.16, 0.49, 0.75), xscale="log", yscale="log")
    for name, curve in points.groupby("estimator"):
        module = modules[name]
        label = module.LABEL + (" (exact)" if name in exact else "")
        curve = curve.sort_values("triangles")
        x, y = _broken(curve.triangles, curve.value, (curve.value <= level).to_numpy(), floor)
        axes.plot(x, y, label=label, clip_on=False, **CURVE | module.STYLE)
    triangles = np.sort(points.triangles.unique())
    axes.set_xticks(triangles, _apart(triangles), fontsize=SMALL)
    axes.set_xticks([], minor=True)
    axes.set_ylim(floor, axes.get_ylim()[1])
    _guide(axes, triangles)
    axes.yaxis.set_minor_formatter(NullFormatter())
    if np.log10(axes.get_ylim()[1] / floor) < 1.5:
        # Powers of ten alone would leave one label or none.
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_major_formatter("{x:g}")
    axes.set_xlabel("triangles")
    symbol, name, unit, *_ = QUANTITIES[quantity]
    axes.set_ylabel(f"mean absolute error of {symbol} ({unit})")
    axes.set_title(f"{modules[surface].LABEL}, {name}", loc="left")
    axes.grid(True, which="major", color="0.9", linewidth=0.6)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure


def _broken(x, y, low, floor):
    """A curve with its `low` points at `floor` and gaps around them."""
    gaps = np.flatnonzero(low[1:] | low[:-1]) + 1
    return np.insert(x * 1.0, gaps, np.nan), np.insert(np.where(low, floor, y), gaps, np.nan)


def _guide(axes, triangles):
    """A thin line with the slope of O(h²), named in the legend, where no curve crosses the name."""
    ends = np.array([triangles[0], triangles[-1]]) * 1.0
    bottom, top = axes.get_ylim()
    start = bottom**0.6 * top**0.4
    axes.plot(ends, start * ends[0] / ends, color="0.6", linewidth=0.8, zorder=1, label="O(h²)")


def _apart(values):
    """Labels of rising values on a logarithmic axis: of the ends, and from the top of those that do
    not overlap another."""
    place = np.log(values)
    digit = (place[-1] - place[0]) / 32  # its width on the axis
    half = digit * (np.char.str_len(values.astype(str)) + 1) / 2
    labelled = [0, len(values) - 1]
    for i in range(len(values) - 2, 0, -1):
        if (np.abs(place[i] - place[labelled]) >= half[i] + half[labelled]).all():
            labelled.append(i)
    return [str(value) if i in labelled else "" for i, value in enumerate(values)]


def _shown(table, surfaces, quantity):
    """Mask of the rows of a quantity in the default reading, on the paper's cut."""
    here = table.surface.isin(surfaces) & (table.diagonal == "same")
    return here & (table.quantity == quantity) & (table.reading == "default")


@in_style
def rank_plot(ranks, quantity: str, surfaces, modules, n: int) -> Figure:
    """Rank of each estimator on each surface by mean error at resolution `n`, default reading;
    tied estimators stand side by side."""
    shown = ranks[_shown(ranks, surfaces, quantity) & (ranks.n == n) & ranks["rank"].notna()]
    figure = Figure(figsize=(TEXT_WIDTH, 3.1))
    axes = figure.add_axes((0.075, 0.14, 0.7, 0.77))
    for name, own in shown.groupby("estimator"):
        rank = own.set_index("surface")["rank"]
        x, y = [], []
        for i, surface in enumerate(surfaces):
            if surface not in rank:
                continue  # no rank there
            tied = shown[(shown.surface == surface) & (shown["rank"] == rank[surface])]
            beside = sorted(tied.estimator).index(name) - (len(tied) - 1) / 2
            x.append(i + 0.16 * beside)
            y.append(rank[surface])
        style = modules[name].STYLE | {"markersize": 6}
        (marks,) = axes.plot(x, y, label=modules[name].LABEL, **style | {"linestyle": "none"})
        # The thin line only guides the eye from mark to mark.
        axes.plot(x, y, color=marks.get_color(), linewidth=0.5, alpha=0.5, zorder=1)
    axes.invert_yaxis()
    ticks = range(1, int(shown["rank"].max()) + 1) if len(shown) else []
    axes.set_yticks(ticks, ticks, fontsize=8)
    labels = [in_lines(modules[surface].LABEL, 10) for surface in surfaces]
    axes.set_xticks(range(len(surfaces)), labels, fontsize=SMALL)
    axes.set_xlim(-0.4, len(surfaces) - 0.6)
    axes.set_ylabel(f"rank by mean error of {QUANTITIES[quantity].symbol}")
    axes.set_title(f"Ranks for {QUANTITIES[quantity].label} at n = {n}", loc="left")
    if len(shown):
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure
