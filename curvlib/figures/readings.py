"""Specification curves: a claim in every reading and cut, sorted by effect."""

import numpy as np
from matplotlib.figure import Figure

from .style import in_lines, in_style
from .verdicts import VERDICTS

NO_MAJORITY = "no majority"
PALE = "0.86"


@in_style
def specification_curve(claims, readings, claim, surfaces, limit=None, marked=None) -> Figure:
    """One claim in every reading and cut, sorted by effect, above the choices that each makes.

    `claims`: claims.csv; `readings`: reading -> {option: value}, the ones shown; `claim`: its row
    of claims-summary.csv; `surfaces`: for the median effect and its quartiles, drawn as grey bars;
    `limit`: the effect at which the verdict changes, or None or NaN; `marked`: reading -> label, to
    be marked on the paper's cut if it is shown. A point has the colour of the verdict on more than
    half of the surfaces, black if there is none.
    """
    cells = claims[(claims.claim == claim.claim) & claims.surface.isin(surfaces)]
    cells = cells[cells.reading.isin(readings)]
    groups = cells.groupby(["reading", "diagonal"])
    curve = groups.effect.quantile([0.25, 0.5, 0.75]).unstack()
    curve["verdict"] = groups.holds.agg(_majority)
    curve = curve.sort_values(0.5, kind="stable").reset_index()
    choices = [readings[r] | {"cut": d} for r, d in zip(curve.reading, curve.diagonal)]
    rows = [(o, v) for o in ("cut", *_options(readings)) for v in _values(choices, readings, o)]
    height = 3.2 + 0.15 * len(rows)
    figure = Figure(figsize=(7, height))
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[2.3, 0.15 * len(rows)])
    figure.subplots_adjust(
        left=0.17, right=0.93, top=1 - 0.35 / height, bottom=0.5 / height, hspace=0.04
    )
    _curve(above, curve, limit)
    above.set_ylabel(in_lines(claim.measure, 40), fontsize=7.5)
    above.set_title(in_lines(f"{claim.claim}. {claim.sentence}", 96), loc="left", fontsize=8.5)
    _choices(below, choices, rows)
    below.set_xlim(-0.01 * len(curve) - 0.5, 1.01 * len(curve) - 0.5)
    below.set_xlabel(
        f"{len(curve)} combinations of reading and cut, sorted by median effect", fontsize=8
    )
    shown = zip(curve.reading, curve.diagonal)
    places = {reading: place for place, (reading, cut) in enumerate(shown) if cut == "same"}
    found = [(places[name], label) for name, label in (marked or {}).items() if name in places]
    top = above.transAxes.transform((0, 1 + 0.1 * len(found)))
    above.set_ylim(top=above.transData.inverted().transform(top)[1])
    for step, (place, label) in enumerate(found):
        _mark(above, below, place, curve[0.5][place], label, 0.98 - 0.08 * step)
    figure.text(0.01, 0.09 / height, "verdict on more than half of the surfaces:", fontsize=7)
    close = {"ncols": 5, "handlelength": 1.2, "handletextpad": 0.4, "columnspacing": 1}
    key = above.get_legend_handles_labels()
    place = {"loc": "lower left", "bbox_to_anchor": (0.31, 0), "borderaxespad": 0.3}
    figure.legend(*key, fontsize=7, **close, **place).legend_handles[-1].set_linewidth(5)
    return figure


def _majority(verdicts):
    """The verdict on more than half, else NO_MAJORITY."""
    most = max(VERDICTS, key=list(verdicts).count)
    return most if 2 * list(verdicts).count(most) > len(verdicts) else NO_MAJORITY


def _curve(axes, curve, limit):
    """Medians coloured by verdict, bars between the quartiles, a line at the limit."""
    x = np.arange(len(curve))
    for verdict, colour in (VERDICTS | {NO_MAJORITY: "black"}).items():
        of = curve.verdict == verdict
        axes.scatter(x[of], curve[0.5][of], s=7, color=colour, label=verdict, zorder=3)
    bars = {"color": PALE, "linewidth": _width(curve), "zorder": 1}
    axes.vlines(x, curve[0.25], curve[0.75], label="quartiles of the surfaces", **bars)
    limit = np.nan if limit is None else limit
    ends = np.append(curve[[0.25, 0.75]].to_numpy(), limit)
    ends = ends[np.isfinite(ends)]
    if len(ends) and ends.min() > 0 and ends.max() > 50 * ends.min():
        axes.set_yscale("log")
    if np.isfinite(limit):
        axes.axhline(limit, color="0.25", linewidth=0.8, linestyle="--", label="_limit")
        words = f"turns at\n{limit:g}".replace("-", "\N{MINUS SIGN}")
        across = axes.get_yaxis_transform()
        axes.text(1.01, limit, words, transform=across, va="center", fontsize=7)
    axes.tick_params(axis="x", length=0)
    axes.tick_params(labelsize=7.5)


def _choices(axes, choices, rows):
    """A row per value of an option, with a tick for each combination that chooses it."""
    options = list(dict.fromkeys(option for option, _ in rows))
    for row, (option, value) in enumerate(rows):
        if options.index(option) % 2 == 0:
            axes.axhspan(row - 0.5, row + 0.5, color="0.95", linewidth=0, zorder=0)
        made = [x for x, choice in enumerate(choices) if choice.get(option) == value]
        axes.vlines(made, row - 0.28, row + 0.28, color="0.15", linewidth=_width(choices))
    axes.set_yticks(range(len(rows)), [f"{o}: {v}" for o, v in rows], fontsize=7)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.set_xticks([])
    axes.tick_params(axis="y", length=0)


def _width(combinations):
    """Width in points of a combination, a little more than its share, lest gaps show."""
    return 450 / max(len(combinations), 100)


def _mark(above, below, place, effect, label, height):
    """Mark one combination: a line through both panels, a ring on the curve, a label."""
    for axes in (above, below):
        axes.axvline(place, color="black", linewidth=0.6, zorder=2.5)
    above.plot(place, effect, "o", markerfacecolor="none", markeredgecolor="black", markersize=7)
    early = place < below.get_xlim()[1] / 2
    above.annotate(
        label,
        (place, height),
        (4 if early else -4, 0),
        xycoords=above.get_xaxis_transform(),
        textcoords="offset points",
        ha="left" if early else "right",
        va="top",
        fontsize=7.5,
        bbox={"color": "white", "alpha": 0.85, "pad": 0.6},
        zorder=5,
    )


def _options(readings):
    return dict.fromkeys(option for choice in readings.values() for option in choice)


def _values(choices, readings, option):
    """Values of an option in the order of the readings; cuts in alphabetical order."""
    order = [r[option] for r in readings.values() if option in r]
    return dict.fromkeys(order or sorted(c[option] for c in choices))
