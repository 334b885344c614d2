"""On how many surfaces claims hold, by the value of each option, over all joint readings."""

import itertools

import matplotlib
import numpy as np
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Ellipse, Patch, Rectangle

from .style import NO_RANK, SMALL, TEXT_WIDTH, in_lines, in_style

CROSSED = ("pairs", "dihedral")

MOST = {"color": "#A9D3EC", "height": 0.6}
MEAN = {"color": "#0072B2", "marker": "o", "linestyle": "none", "markersize": 3.5}
RING = {"color": "black", "marker": "o", "linestyle": "none", "markersize": 8}
RING |= {"markerfacecolor": "none", "markeredgewidth": 0.9}
WINNER = {"facecolor": "#FDEBC8", "edgecolor": "#D98E00", "linewidth": 0.8}

# Inches.
ROW, LEFT, GAP, HEAD, AXIS, FOOT = 0.165, 1.5, 0.12, 0.62, 0.4, 1.65
BETWEEN = 0.6  # rows between two options


@in_style
def marginals_plot(marginals, explanations, sentences, default, winner) -> Figure:
    """On how many surfaces claims hold at the finest n: a panel per claim, a row per value of an
    option, with the mean and the most over all joint readings with that value. Below, the claim
    shown second by the values of both options CROSSED.

    `marginals`, `explanations`: the tables of these names; `sentences`: of the claims to show, by
    number; `default`, `winner`: option -> value in the default reading and in the best explanation
    ({} where there is none).
    """
    claims = [claim for claim in sentences if claim in set(explanations.claim)]
    if not claims:
        figure = Figure(figsize=(TEXT_WIDTH, 1))
        figure.text(0.5, 0.5, "this study has no joint readings", ha="center")
        return figure
    crossed = " x ".join(CROSSED)
    tops, top = {}, 0.0
    single = marginals[marginals.option != crossed]
    for option, rows in single.groupby("option", sort=False):
        for value in rows.value.unique():
            tops[option, value] = top
            top += 1
        top += BETWEEN
    height = (top - BETWEEN) * ROW
    size = np.array([TEXT_WIDTH, HEAD + height + AXIS + FOOT])
    figure = Figure(figsize=size)
    place = _Inches(figure, size)
    behind = place(0, FOOT + AXIS, TEXT_WIDTH, height)
    _labels(behind, tops, winner)
    width = (TEXT_WIDTH - LEFT - (len(claims) - 1) * GAP - 0.05) / len(claims)
    for k, claim in enumerate(claims):
        axes = place(LEFT + k * (width + GAP), FOOT + AXIS, width, height)
        axes.set_ylim(behind.get_ylim())
        _panel(axes, tops, single[single.claim == claim], default)
        of = explanations[explanations.claim == claim]
        _without_rank(axes, of.of.max() - of.degenerate.min(), of.of.max())
        words = in_lines(f"{claim}. {sentences[claim]}", 22)
        axes.set_title(words, loc="left", fontsize=SMALL, linespacing=1.05)
    figure.text(
        (LEFT + TEXT_WIDTH) / 2 / TEXT_WIDTH,
        (FOOT + 0.08) / size[1],
        "surfaces on which the claim holds at the finest n",
        ha="center",
    )
    of_both = marginals[marginals.option == crossed]
    if len(of_both) and len(claims) > 1:
        axes = place(LEFT, 0.05, 2.1, 1.1)
        _matrix(axes, of_both[of_both.claim == claims[1]], default, winner)
        words = f"claim {claims[1]}, {' and '.join(CROSSED)}: mean (most)"
        axes.set_title(words, loc="left", fontsize=SMALL)
    _legend(figure, winner)
    return figure


class _Inches:
    """Adds axes to a figure at (left, bottom, width, height) in inches, without a background."""

    def __init__(self, figure, size):
        self.figure, self.size = figure, np.tile(size, 2)

    def __call__(self, *place):
        axes = self.figure.add_axes(np.array(place) / self.size)
        axes.patch.set_visible(False)
        axes.spines[:].set_visible(False)
        axes.tick_params(length=0, labelsize=SMALL)
        return axes


def _labels(axes, tops, winner):
    """Names of options and values, with a band behind the rows of the winner."""
    axes.set_xlim(0, TEXT_WIDTH)
    axes.set_ylim(max(tops.values()) + 1, 0)
    axes.set_axis_off()
    named = set()
    for (option, value), top in tops.items():
        if option not in named:
            named.add(option)
            words = in_lines(option.replace("_", " "), 11)
            axes.text(0.05, top + 0.1, words, va="top", fontsize=SMALL, linespacing=1.05)
        if winner.get(option) == value:
            left = LEFT - 0.8
            band = Rectangle((left, top + 0.05), TEXT_WIDTH - left - 0.02, 0.9, **WINNER)
            axes.add_patch(band)
        style = {"ha": "right", "va": "center", "fontsize": SMALL}
        axes.text(LEFT - 0.07, top + 0.5, value, **style)


def _panel(axes, tops, rows, default):
    for row in rows.itertuples():
        y = tops[row.option, row.value] + 0.5
        axes.barh(y, row.most, **MOST)
        axes.plot(row.mean, y, **MEAN)
        if default.get(row.option) == row.value:
            axes.plot(row.mean, y, **RING)


def _without_rank(axes, ranked, of):
    bottom, top = axes.get_ylim()
    hatched = NO_RANK | {"facecolor": "none", "zorder": 0.5}
    axes.add_patch(Rectangle((ranked, top), of - ranked, bottom - top, **hatched))
    axes.set_xlim(-0.45, of + 0.1)
    axes.set_xticks(range(of + 1))
    axes.set_yticks([])
    for n in range(of + 1):
        axes.axvline(n, color="0.85", linewidth=0.5, zorder=0.6)


def _matrix(axes, rows, default, winner):
    """The mean and the most by the values of the options CROSSED, as numbers on a colour."""
    found = {tuple(row.value.split(" x ")): row for row in rows.itertuples()}
    down, across = (list(dict.fromkeys(values)) for values in zip(*found))
    colours, norm = matplotlib.colormaps["Blues"], Normalize(0, 1.6 * max(rows["mean"].max(), 1))
    for (y, first), (x, second) in itertools.product(enumerate(down), enumerate(across)):
        row = found[first, second]
        colour = colours(norm(row.mean))
        axes.add_patch(Rectangle((x + 0.02, y + 0.03), 0.96, 0.94, color=colour, linewidth=0))
        words = f"{row.mean:.1f} ({row.most:.0f})"
        axes.text(x + 0.5, y + 0.5, words, ha="center", va="center", fontsize=SMALL)
        if (first, second) == tuple(map(default.get, CROSSED)):
            ring = {"fill": False, "edgecolor": "black", "linewidth": 0.9}
            axes.add_patch(Ellipse((x + 0.5, y + 0.5), 0.8, 0.84, **ring))
        if (first, second) == tuple(map(winner.get, CROSSED)):
            frame = {"fill": False, "edgecolor": WINNER["edgecolor"], "linewidth": 1.6}
            axes.add_patch(Rectangle((x + 0.02, y + 0.03), 0.96, 0.94, **frame))
    axes.set_xlim(0, len(across))
    axes.set_ylim(len(down), 0)
    axes.xaxis.tick_top()
    axes.set_xticks(np.arange(len(across)) + 0.5, across)
    axes.set_yticks(np.arange(len(down)) + 0.5, down)


def _legend(figure, winner):
    handles = [
        Line2D([], [], **MEAN, label="mean over the joint readings with the value"),
        Patch(color=MOST["color"], label="the most in any of them"),
        Line2D([], [], **RING, label="the value in the default reading"),
    ]
    if winner:
        handles.append(Patch(label="the value in the best explanation", **WINNER))
    handles.append(Patch(label="nothing to rank there", **NO_RANK))
    figure.legend(handles=handles, loc="lower right", fontsize=SMALL)
