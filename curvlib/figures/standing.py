"""Errors of one estimator among those of others."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter, NullLocator

from .style import SMALL, TEXT_WIDTH, in_style

MINE, BEST, OTHERS = "#D55E00", "#0072B2", "0.8"
SHOWN = ("K", "H")


@in_style
def standing_plot(table, mine: str) -> Figure:
    """Mean errors of K and H against n, log-log, in a panel for each surface and place of a ranked
    survey: `mine`, the best at the finest n, and all others in grey."""
    places = list(table[["surface", "place"]].drop_duplicates().itertuples(index=False))
    figure = Figure(figsize=(TEXT_WIDTH, 3.6), layout="constrained")
    panels = figure.subplots(len(SHOWN), len(places), sharex=True, squeeze=False)
    ticks = sorted(table.n.unique())
    for row, quantity in zip(panels, SHOWN):
        for axes, (surface, place) in zip(row, places):
            here = table[(table.surface == surface) & (table.place == place)]
            here = here[(here.quantity == quantity) & (here.value > 0)]
            finest = here[here.n == ticks[-1]]
            best = finest.sort_values("value").estimator.iloc[0] if len(finest) else None
            for name, own in here.groupby("estimator"):
                kind = {"color": OTHERS, "linewidth": 0.7}
                if name == best:
                    kind = {"color": BEST, "linewidth": 1.3, "marker": "o", "markersize": 3}
                if name == mine:
                    kind = {"color": MINE, "linewidth": 1.8, "marker": "s", "markersize": 3.5}
                kind["zorder"] = 3 if name == mine else 2 if name == best else 1
                axes.plot(own.n, own.value, **kind)
            axes.set_xscale("log")
            axes.set_yscale("log")
            axes.xaxis.set_minor_locator(NullLocator())
            axes.set_xticks(ticks, ticks, fontsize=SMALL)
            axes.yaxis.set_minor_formatter(NullFormatter())
            _within(axes, here.value)
            if quantity == SHOWN[0]:
                axes.set_title(f"{surface}, {place}", loc="left")
            said = {"fontsize": SMALL - 1, "transform": axes.transAxes}
            axes.text(0.04, 0.03, f"best: {best or 'none'}", color=BEST, **said)
            if not (here.estimator == mine).any():
                axes.text(0.04, 0.1, f"{mine}: no value", color=MINE, **said)
        row[0].set_ylabel(f"mean error of {quantity}")
    figure.supxlabel("n, of meshes of n² vertices", fontsize=8)
    figure.suptitle(f"{mine}, among {table.estimator.nunique() - 1} others", color=MINE, fontsize=9)
    return figure


def _within(axes, values):
    """Limits that leave out the largest tenth of the values, which may be wild."""
    if len(values):
        low, high = values.min(), np.quantile(values, 0.9)
        axes.set_ylim(low / 4, max(high, low) * 2)
