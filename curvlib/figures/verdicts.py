"""The verdicts on the claims, by surface."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from .style import NO_RANK, SMALL, in_lines, in_style

# Fill and ink of a cell; the fills differ in lightness too.
CELLS = {
    "true": ({"facecolor": "#0072B2", "edgecolor": "none"}, "white"),
    "from some n on": ({"facecolor": "#A9D3EC", "edgecolor": "none"}, "black"),
    "undecided": ({"facecolor": "#D5D5D5", "edgecolor": "none"}, "black"),
    "false": ({"facecolor": "#C04F00", "edgecolor": "none"}, "white"),
    "degenerate": (NO_RANK, "black"),
}
LEGEND = {
    "true": "yes",
    "from some n on": "\N{GREATER-THAN OR EQUAL TO}24: undecided; true from n = 24 on",
    "undecided": "?: undecided",
    "false": "no",
    "degenerate": "no rank: the two least errors are rounding",
}

# Inches.
WORDS, CELL, ROW, GAP, HEAD, TITLE, LEGEND_ROW = 2.48, 0.257, 0.335, 0.1, 0.75, 0.3, 0.155
TITLED = 1.0  # what a title takes
THREE_COLUMNS = 5.7  # what the legend takes


@in_style
def claims_map(decided, summary, readings, surfaces, modules) -> Figure:
    """Claims against surfaces, a panel per reading.

    `decided`: the rows of claims.csv to show, a claim about all surfaces together in one bar;
    `summary`: claims-summary.csv; `readings`: title of a panel by reading; `surfaces` in order;
    `modules`: the module of every surface, by name.
    """
    numbers = sorted(decided.claim.unique())
    panel, rows = CELL * len(surfaces), ROW * len(numbers)
    step = max(panel, TITLED) + GAP
    width = WORDS + len(readings) * step
    columns = 3 if width > THREE_COLUMNS else 1
    foot = TITLE + LEGEND_ROW * -(-len(LEGEND) // columns)
    size = np.array([width, HEAD + rows + foot])
    figure = Figure(figsize=size)
    inch = 1 / np.tile(size, 2)
    for k, (reading, title) in enumerate(readings.items()):
        axes = figure.add_axes(np.array([WORDS + k * step, foot, panel, rows]) * inch)
        here = decided[decided.reading == reading]
        for row in here.itertuples():
            together = row.surface not in surfaces
            left = 0 if together else surfaces.index(row.surface)
            _cell(axes, left, numbers.index(row.claim), len(surfaces) if together else 1, row)
        axes.set_xlim(0, len(surfaces))
        axes.set_ylim(len(numbers), 0)
        sentences = summary.set_index("claim").sentence
        sentences = [in_lines(f"{c}. {sentences[c]}", 46) for c in numbers] if k == 0 else []
        axes.set_yticks(np.arange(len(sentences)) + 0.5, sentences, fontsize=SMALL)
        labels = [in_lines(modules[surface].LABEL, 12) for surface in surfaces]
        axes.xaxis.tick_top()
        axes.set_xticks(np.arange(len(labels)) + 0.5, labels, rotation=90, fontsize=SMALL)
        for label in [*axes.get_xticklabels(), *axes.get_yticklabels()]:
            label.set_linespacing(1.0)
        axes.tick_params(length=0)
        axes.spines[:].set_visible(False)
        axes.text(0, -0.06 / rows, title, transform=axes.transAxes, va="top")
    handles = [Patch(label=label, **CELLS[kind][0]) for kind, label in LEGEND.items()]
    style = {"ncols": columns, "fontsize": SMALL, "columnspacing": 1.2, "borderaxespad": 0.2}
    figure.legend(handles=handles, loc="lower center", **style)
    return figure


def _cell(axes, left, top, width, row):
    """The verdict of a row of claims.csv in words, `width` cells wide."""
    signs = {"true": "yes", "false": "no", "undecided": "?" if width == 1 else "undecided"}
    kind, sign = row.holds, signs.get(row.holds, "")
    if kind == "undecided" and np.isfinite(row.from_n):
        kind, sign = "from some n on", f"\N{GREATER-THAN OR EQUAL TO}{row.from_n:.0f}"
    fill, ink = CELLS[kind]
    axes.add_patch(Rectangle((left + 0.03, top + 0.03), width - 0.06, 0.94, **fill))
    place = (left + width / 2, top + 0.5)
    axes.text(*place, sign, ha="center", va="center", fontsize=SMALL, color=ink)
