"""How alike the rankings on two surfaces are."""

import itertools

import matplotlib
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from .style import NO_RANK, SMALL, TEXT_WIDTH, in_lines, in_style

COLOURS = matplotlib.colormaps["RdBu"]
TAU = Normalize(-1, 1)

# Inches.
ROW, LEFT, GAP, HEAD, FOOT = 0.26, 0.75, 0.25, 0.3, 1.22


@in_style
def agreement_plot(agreement, readings, surfaces, modules) -> Figure:
    """Kendall's tau between the rankings on each two surfaces, a column of panels per quantity, a
    row per reading.

    `agreement`: agreement.csv; `readings`: title of a row by reading; `surfaces` in order;
    `modules`: the module of every surface, by name.
    """
    across, down = surfaces[:-1], surfaces[1:]
    rows = [reading for reading in readings if reading in set(agreement.reading)]
    quantities = agreement.quantity.unique()
    if not rows or not down:
        figure = Figure(figsize=(TEXT_WIDTH, 1))
        figure.text(0.5, 0.5, "no two rankings of the nine in this study", ha="center")
        return figure
    tau = agreement.set_index(["reading", "quantity", "surface", "other"]).tau
    panel = np.array([(TEXT_WIDTH - LEFT - GAP) / 2, ROW * len(down)])
    size = np.array([TEXT_WIDTH, len(rows) * (HEAD + panel[1]) + FOOT])
    figure = Figure(figsize=size)
    labels = {surface: in_lines(modules[surface].LABEL, 12) for surface in surfaces}
    for (i, reading), (j, quantity) in itertools.product(enumerate(rows), enumerate(quantities)):
        left = LEFT + j * (panel[0] + GAP)
        bottom = FOOT + (len(rows) - 1 - i) * (HEAD + panel[1])
        axes = figure.add_axes([*np.array([left, bottom]) / size, *panel / size])
        axes.set_title(f"{quantity}, {readings[reading]}", loc="left")
        axes.set_xlim(0, len(across))
        axes.set_ylim(len(down), 0)
        for (y, surface), (x, other) in itertools.product(enumerate(down), enumerate(across)):
            if x <= y:
                _cell(axes, x, y, tau[reading, quantity, surface, other])
        seen = list(labels.values())
        axes.set_yticks(np.arange(len(down)) + 0.5, seen[1:] if j == 0 else [])
        last = i == len(rows) - 1
        axes.set_xticks(np.arange(len(across)) + 0.5, seen[:-1] if last else [], rotation=90)
        axes.tick_params(length=0, labelsize=SMALL)
        axes.spines[:].set_visible(False)
    bar = figure.add_axes([*np.array([LEFT, 0.3]) / size, *np.array([panel[0], 0.1]) / size])
    bar = figure.colorbar(ScalarMappable(TAU, COLOURS), bar, orientation="horizontal")
    bar.set_ticks([-1, 0, 1], labels=["\N{MINUS SIGN}1: reversed", "0", "1: the same"])
    bar.ax.tick_params(labelsize=SMALL, length=2)
    bar.ax.set_title("Kendall's tau", fontsize=SMALL, pad=2)
    bar.outline.set_visible(False)
    no_rank = Patch(label="no ranking on one of the two", **NO_RANK)
    figure.legend(handles=[no_rank], loc="lower right", fontsize=SMALL)
    return figure


def _cell(axes, x, y, tau):
    fill = {"color": COLOURS(TAU(tau)), "linewidth": 0} if np.isfinite(tau) else NO_RANK
    axes.add_patch(Rectangle((x + 0.02, y + 0.03), 0.96, 0.94, **fill))
    if np.isfinite(tau):
        style = {"fontsize": SMALL, "color": "white" if abs(tau) > 0.65 else "black"}
        value = f"{tau:z.2f}".replace("-", "\N{MINUS SIGN}")
        axes.text(x + 0.5, y + 0.5, value, ha="center", va="center", **style)
