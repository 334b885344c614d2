"""Errors on rings that shrink on a quadric, valence by valence."""

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter
from matplotlib.transforms import ScaledTranslation
from scipy.optimize import isotonic_regression

from curvlib.comparison.quantities import QUANTITIES, difference

from .style import SMALL, TEXT_WIDTH, WITH_EXPONENTS, in_style

ABSENT = "not in this study"


@in_style
def rings_plot(rings, slopes, variants, quantity: str) -> Figure:
    """Error against ring size on quadrics, a line per valence, labelled with its order.

    `slopes`: rings.csv; `variants`: (estimator, variant, label) of the columns. Regular rings in
    the upper row, irregular ones in the lower.
    """
    if not variants:
        figure = Figure(figsize=(TEXT_WIDTH, 1))
        figure.text(0.5, 0.5, ABSENT, ha="center", va="center")
        return figure
    figure = Figure(figsize=(TEXT_WIDTH, 4.4))
    panels = figure.subplots(2, len(variants), sharex=True, sharey=True, squeeze=False)
    figure.subplots_adjust(left=0.125, right=0.905, bottom=0.12, top=0.945, wspace=0.5, hspace=0.1)
    valences = sorted(rings.valence.unique())
    # The dark part of the colormap, legible as text.
    shades = matplotlib.colormaps["plasma"](np.linspace(0, 0.62, len(valences)))
    rings, slopes = (t[t.quantity == quantity] for t in (rings, slopes))
    key = ["estimator", "variant", "ring"]
    for row, kind in zip(panels, ("regular", "irregular")):
        for axes, (estimator, variant, label) in zip(row, variants):
            curves, orders = (
                t[(t[key] == [estimator, variant, kind]).all(axis=1)] for t in (rings, slopes)
            )
            orders = -orders.set_index("valence").slope
            for valence, shade in zip(valences, shades):
                curve = curves[curves.valence == valence].sort_values("h", ascending=False)
                axes.loglog(curve.h, curve.value, color=shade, linewidth=1.0)
                axes.lines[-1].set_label(f"{valence}: {orders.get(valence, np.nan):z.1f}")
            axes.set_title(label if kind == "regular" else "", loc="left", fontsize=8)
            axes.grid(True, which="major", color="0.92", linewidth=0.6)
        row[0].set_ylabel(f"{kind} rings", fontsize=8)
    # h falls to the right, so that refinement runs as in the error plots.
    panels[0][0].invert_xaxis()
    for axes in panels.flat:
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_minor_formatter(NullFormatter())
        _label_ends(axes, "valence: p")
    style = {"fontsize": WITH_EXPONENTS, "ha": "center", "va": "center"}
    figure.text(0.5, 0.022, "ring size h (length); the error falls like O($h^p$)", **style)
    error = f"mean of {difference(quantity, quantity)} ({QUANTITIES[quantity].unit})"
    figure.text(0.017, 0.525, error, rotation=90, **style)
    return figure


def _label_ends(axes, heading, step=0.075):
    """Label lines beside their right ends, at least `step` of the axes apart."""
    lines = [line for line in axes.lines if np.isfinite(line.get_ydata()).any()]
    ends = [axes.transData.transform(line.get_xydata()[-1]) for line in lines]
    if not ends:
        axes.text(0.5, 0.5, ABSENT, transform=axes.transAxes, ha="center", fontsize=8)
        return
    ends = axes.transAxes.inverted().transform(ends)
    order = np.argsort(ends[:, 1], kind="stable")
    apart = step * np.arange(len(lines))
    heights = isotonic_regression(ends[order, 1] - apart).x.clip(0.02, 0.88 - apart[-1]) + apart
    beside = axes.transAxes + ScaledTranslation(9 / 72, 0, axes.figure.dpi_scale_trans)
    style = {"textcoords": beside, "va": "center", "fontsize": SMALL}
    leader = {"arrowstyle": "-", "relpos": (0, 0.5), "shrinkA": 0, "shrinkB": 0, "linewidth": 0.5}
    for k, height in zip(order, heights):
        colour = {"color": lines[k].get_color()}
        ahead = {"xy": ends[k], "xycoords": "axes fraction", "arrowprops": leader | colour}
        axes.annotate(lines[k].get_label(), xytext=(1, height), **ahead, **style, **colour)
    axes.text(0.98, 0.97, heading, transform=axes.transAxes, va="center", fontsize=SMALL)
