"""Pictures of the claims: verdicts by surface, readings by effect, errors on shrinking rings."""

from textwrap import wrap

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from .figures import SYMBOLS, UNITS

# True, undecided, false: told apart by lightness too.
VERDICTS = {"true": "#0072B2", "undecided": "#BBBBBB", "false": "#D55E00"}


def specification_curve(claims, readings, claim, surfaces) -> Figure:
    """One claim in every reading and cut, sorted by effect; below, the choices that each makes.

    `claims`: claims.csv; `readings`: reading -> {option: value}, those to show; `claim`: its row
    of claims-summary.csv; `surfaces`: those over which the median effect is taken. A point's
    colour is the verdict on most of them; the grey bar runs from the least to the largest effect.
    """
    cells = claims[(claims.claim == claim.claim) & claims.surface.isin(surfaces)]
    cells = cells[cells.reading.isin(readings)]
    groups = cells.groupby(["reading", "diagonal"])
    curve = groups.effect.agg(["min", "median", "max"])
    curve["verdict"] = groups.holds.agg(lambda holds: holds.value_counts().index[0])
    curve = curve.sort_values("median", kind="stable").reset_index()
    choices = [readings[r] | {"cut": d} for r, d in zip(curve.reading, curve.diagonal)]
    rows = [(o, v) for o in ("cut", *_options(readings)) for v in _values(choices, readings, o)]
    x = np.arange(len(curve))
    figure = Figure(figsize=(7, 3 + 0.14 * len(rows)))
    above, below = figure.subplots(2, 1, sharex=True, height_ratios=[2.6, 0.14 * len(rows)])
    figure.subplots_adjust(left=0.2, right=0.98, top=0.93, bottom=0.09, hspace=0.05)
    above.vlines(x, curve["min"], curve["max"], color="0.85", linewidth=1)
    for verdict, colour in VERDICTS.items():
        of = curve.verdict == verdict
        above.scatter(x[of], curve["median"][of], s=6, color=colour, label=verdict, zorder=3)
    finite = np.concatenate([curve["min"], curve["max"]])
    finite = finite[np.isfinite(finite)]
    if len(finite) and finite.min() > 0 and finite.max() > 50 * finite.min():
        above.set_yscale("log")
    above.set_ylabel("\n".join(wrap(claim.measure, 34)), fontsize=7.5)
    above.set_title(
        "\n".join(wrap(f"{claim.claim}. {claim.sentence}", 100)), loc="left", fontsize=8
    )
    figure.legend(loc="lower left", ncols=3, fontsize=7, handletextpad=0, columnspacing=0.6)
    figure.text(0.01, 0.045, "verdict on most surfaces", fontsize=7)
    for row, (option, value) in enumerate(rows):
        made = [c.get(option) == value for c in choices]
        below.scatter(x[made], np.full(sum(made), row), s=4, marker="|", color="0.15")
    below.set_yticks(range(len(rows)), [f"{o}: {v}" for o, v in rows], fontsize=6.5)
    below.set_ylim(len(rows) - 0.3, -0.7)
    below.set_xticks([])
    below.set_xlabel(f"{len(curve)} combinations of reading and cut, sorted by median effect")
    return figure


def claims_map(claims, summary, surfaces, modules) -> Figure:
    """Claims against surfaces: the default reading, on the grid that the paper has."""
    cells = claims[(claims.reading == "default") & (claims.diagonal == "same")]
    holds = cells.pivot(index="claim", columns="surface", values="holds")[surfaces]
    figure = Figure(figsize=(7.2, 4.2))
    axes = figure.add_axes((0.47, 0.02, 0.44, 0.75))
    for i, claim in enumerate(holds.index):
        for j, surface in enumerate(surfaces):
            verdict = holds.loc[claim, surface]
            axes.add_patch(Rectangle((j, i), 0.94, 0.92, color=VERDICTS[verdict]))
            sign = {"true": "yes", "false": "no", "undecided": "?"}[verdict]
            colour = "black" if verdict == "undecided" else "white"
            axes.text(j + 0.47, i + 0.48, sign, ha="center", va="center", fontsize=8, color=colour)
    axes.set_xlim(0, len(surfaces))
    axes.set_ylim(len(holds), 0)
    sentences = ["\n".join(wrap(f"{c}. {s}", 52)) for c, s in zip(summary.claim, summary.sentence)]
    axes.set_yticks(np.arange(len(holds)) + 0.46, sentences, fontsize=6.5)
    axes.xaxis.tick_top()
    labels = [modules[surface].LABEL for surface in surfaces]
    axes.set_xticks(np.arange(len(surfaces)) + 0.47, labels, rotation=40, ha="left", fontsize=7.5)
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)
    return figure


def rings_plot(rings, slopes, variants, quantity: str) -> Figure:
    """Error against ring size on a quadric, valence by valence, with the fitted orders.

    `slopes`: rings.csv. `variants`: (estimator, variant, label) of the columns; regular rings
    full, irregular dashed.
    """
    slopes = slopes.set_index(["estimator", "variant", "quantity", "valence", "ring"]).slope
    figure = Figure(figsize=(7.4, 3.4))
    panels = figure.subplots(1, len(variants), sharey=True, squeeze=False)[0]
    figure.subplots_adjust(left=0.08, right=0.9, bottom=0.17, top=0.9, wspace=0.35)
    colours = matplotlib.colormaps["viridis"](np.linspace(0, 0.9, rings.valence.nunique()))
    for axes, (estimator, variant, label) in zip(panels, variants):
        of = (rings.estimator == estimator) & (rings.variant == variant)
        curves = rings[of & (rings.quantity == quantity)]
        ends = []
        for colour, (valence, both) in zip(colours, curves.groupby("valence")):
            for kind, line in (("regular", "-"), ("irregular", "--")):
                p = both[both.ring == kind].sort_values("h")
                axes.loglog(p.h, p.value, line, color=colour, linewidth=1)
                order = -slopes.loc[(estimator, variant, quantity, valence, kind)]
                ends.append((p.value.iloc[-1], f"{valence}{kind[0]}: {order:z.1f}", colour))
        axes.set_title(label, loc="left", fontsize=8)
        axes.set_xlabel("ring size h (length)")
        for place, (_, text, colour) in enumerate(sorted(ends, key=lambda end: -end[0])):
            axes.text(
                1.02,
                1 - 0.07 * place,
                text,
                transform=axes.transAxes,
                va="top",
                fontsize=6,
                color=colour,
            )
    note = "beside a panel: valence, r(egular, full line) or i(rregular, dashed): p of O(h^p)"
    figure.text(0.98, 0.02, note, ha="right", fontsize=6)
    panels[0].set_ylabel(f"mean absolute error of {SYMBOLS[quantity]} ({UNITS[quantity]})")
    return figure


def _options(readings):
    return dict.fromkeys(option for choice in readings.values() for option in choice)


def _values(choices, readings, option):
    """Values of an option in the order of the readings; of the cut in that of their names."""
    order = [r[option] for r in readings.values() if option in r]
    return dict.fromkeys(order or sorted(c[option] for c in choices))
