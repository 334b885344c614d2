"""Errors and ranks of the estimators against resolution and surface."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from curvlib.comparison.quantities import QUANTITIES

from .style import in_style


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
    figure = Figure(figsize=(6.3, 3.9))
    # Fixed axes: matplotlib's layout engines take longer than the drawing.
    axes = figure.add_axes((0.11, 0.12, 0.58, 0.8), xscale="log", yscale="log")
    for name, curve in points.groupby("estimator"):
        module = modules[name]
        label = module.LABEL + (" (exact)" if name in exact else "")
        curve = curve.sort_values("triangles")
        x, y = _broken(curve.triangles, curve.value, (curve.value <= level).to_numpy(), floor)
        axes.plot(x, y, label=label, clip_on=False, markersize=5, **module.STYLE)
    triangles = np.sort(points.triangles.unique())
    axes.set_xticks(triangles, _apart(triangles))
    axes.set_xticks([], minor=True)
    axes.set_ylim(floor, axes.get_ylim()[1])
    _guide(axes, triangles)
    axes.yaxis.set_minor_formatter(NullFormatter())
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
    """A thin line with the slope of O(h²)."""
    ends = np.array([triangles[0], triangles[-1]]) * 1.0
    bottom, top = axes.get_ylim()
    start = bottom**0.6 * top**0.4
    axes.plot(ends, start * ends[0] / ends, color="0.6", linewidth=0.8, zorder=1, label="_guide")
    axes.annotate("O(h²)", (ends[0], start), (3, 3), textcoords="offset points", fontsize=7)


def _apart(values):
    """Labels of rising values on a logarithmic axis, empty where they would overlap the next."""
    step = np.log(values[-1] / values[0]) / 12
    labels, above = [], np.inf
    for value in values[::-1]:
        far = np.log(above / value) >= step
        labels.append(str(value) if far else "")
        above = value if far else above
    return labels[::-1]


def _shown(table, surfaces, quantity):
    """Mask of the rows of a quantity in the default reading, on the paper's cut."""
    here = table.surface.isin(surfaces) & (table.diagonal == "same")
    return here & (table.quantity == quantity) & (table.reading == "default")


@in_style
def rank_plot(ranks, quantity: str, surfaces, modules, n: int) -> Figure:
    """Rank of each estimator on each surface by mean error at resolution `n`, default reading;
    tied estimators stand side by side."""
    shown = ranks[_shown(ranks, surfaces, quantity) & (ranks.n == n)]
    figure = Figure(figsize=(7.2, 3.8))
    axes = figure.add_axes((0.07, 0.19, 0.71, 0.72))
    for name, own in shown.groupby("estimator"):
        rank = own.set_index("surface")["rank"]
        x, y = [], []
        for i, surface in enumerate(surfaces):
            if surface not in rank:
                continue  # no estimate there
            tied = shown[(shown.surface == surface) & (shown["rank"] == rank[surface])]
            beside = sorted(tied.estimator).index(name) - (len(tied) - 1) / 2
            x.append(i + 0.16 * beside)
            y.append(rank[surface])
        style = modules[name].STYLE | {"markersize": 7}
        (marks,) = axes.plot(x, y, label=modules[name].LABEL, **style | {"linestyle": "none"})
        # The thin line only guides the eye from mark to mark.
        axes.plot(x, y, color=marks.get_color(), linewidth=0.5, alpha=0.5, zorder=1)
    axes.invert_yaxis()
    axes.set_yticks(range(1, shown["rank"].max() + 1) if len(shown) else [])
    labels = [modules[surface].LABEL for surface in surfaces]
    angle = {"rotation": 20, "ha": "right", "rotation_mode": "anchor", "fontsize": 8}
    axes.set_xticks(range(len(surfaces)), labels, **angle)
    axes.set_ylabel(f"rank by mean error of {QUANTITIES[quantity].symbol}")
    axes.set_title(f"Ranks for {QUANTITIES[quantity].label} at n = {n}", loc="left")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=8)
    return figure
