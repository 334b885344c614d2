"""Pictures of the claims: verdicts by surface, readings by effect, errors on shrinking rings."""

from textwrap import wrap

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.transforms import ScaledTranslation
from scipy.optimize import isotonic_regression

from .curves import UNITS

# True, undecided, false: told apart by lightness too.
VERDICTS = {"true": "#0072B2", "undecided": "#999999", "false": "#D55E00"}
NO_MAJORITY = "no majority"
PALE = "0.86"
ABSOLUTE = {q: rf"$|{q} - {q}_\mathrm{{est}}|$" for q in "KH"}
ABSENT = "not in this study"


def specification_curve(claims, readings, claim, surfaces, limit=None, marked=None) -> Figure:
    """One claim in every reading and cut, sorted by effect; below, the choices that each makes.

    `claims`: claims.csv; `readings`: reading -> {option: value}, those to show; `claim`: its row
    of claims-summary.csv; `surfaces`: those over which the median effect is taken, and grey bars
    from the lower to the upper quartile; `limit`: the effect at which the claim turns, None or NaN
    without one; `marked`: reading -> label, to be pointed out on the paper's grid where they are
    shown. A point's colour is the verdict on more than half of the surfaces, black where none is.
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
    above.set_ylabel(_lines(claim.measure, 40), fontsize=7.5)
    above.set_title(_lines(f"{claim.claim}. {claim.sentence}", 96), loc="left", fontsize=8.5)
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
    """The verdict of more than half, if there is one."""
    most = max(VERDICTS, key=list(verdicts).count)
    return most if 2 * list(verdicts).count(most) > len(verdicts) else NO_MAJORITY


def _curve(axes, curve, limit):
    """Medians coloured by verdict, bars between the quartiles, a line where the claim turns."""
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
    """Points that one of them takes, or a little more, lest gaps show between neighbours."""
    return 450 / max(len(combinations), 100)


def _mark(above, below, place, effect, label, height):
    """Point out one combination: a line through both panels, a ring on the curve, its label."""
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


def claims_map(verdicts, summary, modules) -> Figure:
    """Claims against surfaces: yes, no or undecided.

    `verdicts`: a row per claim, by number, a column per surface; `summary`: claims-summary.csv;
    `modules`: the module of every surface, by name.
    """
    figure = Figure(figsize=(7.2, 4.9))
    axes = figure.add_axes((0.45, 0.015, 0.455, 0.79))
    for i, row in enumerate(verdicts.to_numpy()):
        for j, verdict in enumerate(row):
            axes.add_patch(Rectangle((j, i), 0.94, 0.92, color=VERDICTS[verdict]))
            sign = {"true": "yes", "false": "no", "undecided": "?"}[verdict]
            colour = "black" if verdict == "undecided" else "white"
            axes.text(j + 0.47, i + 0.48, sign, ha="center", va="center", fontsize=9, color=colour)
    axes.set_xlim(0, len(verdicts.columns))
    axes.set_ylim(len(verdicts), 0)
    sentences = summary.set_index("claim").sentence
    sentences = [_lines(f"{c}. {sentences[c]}", 50) for c in verdicts.index]
    axes.set_yticks(np.arange(len(verdicts)) + 0.46, sentences, fontsize=8.2, linespacing=1.05)
    axes.xaxis.tick_top()
    labels = [modules[surface].LABEL for surface in verdicts.columns]
    middles = np.arange(len(labels)) + 0.47
    axes.set_xticks(middles, labels, rotation=40, ha="left", rotation_mode="anchor", fontsize=8)
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)
    return figure


def rings_plot(rings, slopes, variants, quantity: str) -> Figure:
    """Error against ring size on a quadric, a line per valence, at whose end its order stands.

    `slopes`: rings.csv; `variants`: (estimator, variant, label) of the columns. Regular rings in
    the upper row, irregular ones in the lower.
    """
    if not variants:
        figure = Figure(figsize=(7, 1))
        figure.text(0.5, 0.5, ABSENT, ha="center", va="center")
        return figure
    figure = Figure(figsize=(7, 5.2))
    panels = figure.subplots(2, len(variants), sharex=True, sharey=True, squeeze=False)
    figure.subplots_adjust(left=0.115, right=0.915, bottom=0.1, top=0.95, wspace=0.45, hspace=0.1)
    valences = sorted(rings.valence.unique())
    # Only so far as the colours are dark enough for text.
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
                axes.loglog(curve.h, curve.value, color=shade, linewidth=1.1)
                axes.lines[-1].set_label(f"{valence}: {orders.get(valence, np.nan):z.1f}")
            axes.set_title(label if kind == "regular" else "", loc="left", fontsize=8.5)
            axes.tick_params(labelsize=7.5)
            axes.grid(True, which="major", color="0.92", linewidth=0.6)
        row[0].set_ylabel(f"{kind} rings", fontsize=8.5)
    # Towards the right rings shrink, as meshes are refined in the plots of errors.
    panels[0][0].invert_xaxis()
    for axes in panels.flat:
        _label_ends(axes, "valence: p")
    style = {"fontsize": 8.5, "ha": "center", "va": "center"}
    figure.text(0.5, 0.022, "ring size h (length); the error falls like O($h^p$)", **style)
    error = f"mean of {ABSOLUTE[quantity]} ({UNITS[quantity]})"
    figure.text(0.017, 0.525, error, rotation=90, **style)
    return figure


def _label_ends(axes, heading, step=0.075):
    """The labels of lines beside their right ends, `step` of the axes apart at least."""
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
    style = {"textcoords": beside, "va": "center", "fontsize": 7.5}
    leader = {"arrowstyle": "-", "relpos": (0, 0.5), "shrinkA": 0, "shrinkB": 0, "linewidth": 0.5}
    for k, height in zip(order, heights):
        colour = {"color": lines[k].get_color()}
        ahead = {"xy": ends[k], "xycoords": "axes fraction", "arrowprops": leader | colour}
        axes.annotate(lines[k].get_label(), xytext=(1, height), **ahead, **style, **colour)
    axes.text(0.98, 0.97, heading, transform=axes.transAxes, va="center", fontsize=7.5)


def _lines(words, most):
    """Words in as few lines of at most `most` letters as hold them, all about as long; powers and
    signs as printed."""
    words = words.replace("^2", "²").replace(" -", " \N{MINUS SIGN}")
    whole = {"break_long_words": False, "break_on_hyphens": False}
    tries = [wrap(words, width, **whole) for width in range(1, most + 1)]
    return "\n".join(next(lines for lines in tries if len(lines) == len(tries[-1])))


def _options(readings):
    return dict.fromkeys(option for choice in readings.values() for option in choice)


def _values(choices, readings, option):
    """Values of an option in the order of the readings; of the cut in that of their names."""
    order = [r[option] for r in readings.values() if option in r]
    return dict.fromkeys(order or sorted(c[option] for c in choices))
