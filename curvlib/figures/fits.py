"""Figures of the article on estimators past 2003: noise, order, cost, ablation, where they fail."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from curvlib.comparison.ablation import GAIN, SLOPE
from curvlib.comparison.frontier import REFERENCE
from curvlib.comparison.quantities import QUANTITIES

from .style import SMALL, TEXT_WIDTH, in_style

# Of the calls of the article, by colours and markers that are told apart without colour too.
LOOKS = {
    "adaptive_fit": ("adaptive_fit", "black", "P"),
    "compact_hermite": ("compact, degree 6", "#117733", "D"),
    "compact_hermite(degree=5)": ("compact, degree 5", "#66A61E", "d"),
    "compact_hermite(degree=4)": ("compact, degree 4", "#999933", "v"),
    "jet(degree=6, rings=3)": ("jet, degree 6", "#332288", "o"),
    "jet(degree=4)": ("jet, degree 4", "#88CCEE", "s"),
    REFERENCE: ("CGAL's fit, degree 4", "#CC3311", "X"),
    "gauss_bonnet": ("angle defect", "0.55", "^"),
}
MARKERS = "osD^vP"
# Of changes in ablation-jets.csv.
WORDS = {
    "centre=free": "not through the vertex",
    "weights=none": "no weights",
    "centre=free, weights=none": "neither",
    "frame=refitted": "frame of a first fit",
    "sine=0.03": "guard 0.03",
    "sine=0.0003": "guard 0.0003",
    "sine=3e-05": "guard 0.00003",
}
GRID = {"which": "major", "color": "0.92", "linewidth": 0.6}


@in_style
def noise_plot(table) -> Figure:
    """Error of H and K against the level of white noise: adaptive.csv. A grey line per fixed fit,
    their envelope in black, `adaptive_fit` as markers; a panel per surface and quantity."""
    white = table[table.noise == "white"]
    surfaces, levels = list(dict.fromkeys(white.surface)), sorted(white.level.unique())
    figure = Figure(figsize=(TEXT_WIDTH, 4.3), layout="constrained")
    panels = figure.subplots(2, len(surfaces), sharex=True, squeeze=False)
    places = np.arange(len(levels))
    for row, quantity in zip(panels, ("K", "H")):
        for axes, surface in zip(row, surfaces):
            there = white[(white.surface == surface) & (white.quantity == quantity)]
            curves = there.pivot(index="level", columns="fit", values="value")
            others = curves.drop(columns="adaptive_fit")
            axes.semilogy(places, others, color="0.8", linewidth=0.6)
            axes.semilogy(places, others.min(axis=1), color="black", linewidth=1.2)
            style = {"marker": "P", "markersize": 6, "linestyle": "", "markeredgecolor": "white"}
            axes.semilogy(places, curves.adaptive_fit, color="#CC3311", **style)
            axes.set_xticks(places, map(_level, levels), fontsize=SMALL, rotation=50)
            axes.minorticks_off()
            axes.grid(True, axis="y", **GRID)
            if quantity == "K":
                axes.set_title(surface, loc="left")
        row[0].set_ylabel(f"mean error of {quantity} ({QUANTITIES[quantity].unit})")
    panels[-1][len(surfaces) // 2].set_xlabel("noise (mean edges)")
    return figure


def _level(level):
    return f"$10^{{{np.log10(level):.0f}}}$" if 0 < level < 0.01 else f"{level:g}"


@in_style
def order_plot(table, surfaces, quantity: str) -> Figure:
    """Error inside against n on jittered meshes: accuracy.csv; a panel per surface."""
    figure = Figure(figsize=(TEXT_WIDTH, 3.4), layout="constrained")
    panels = figure.subplots(1, len(surfaces), sharey=True, squeeze=False)[0]
    there = table[(table.kind == "jittered") & (table.place == "interior")]
    there = there[there.quantity == quantity]
    for axes, surface in zip(panels, surfaces):
        for name, (label, colour, marker) in LOOKS.items():
            curve = there[(there.surface == surface) & (there.estimator == name)].sort_values("n")
            if name == "adaptive_fit" or curve.empty:
                continue  # on exact vertices it takes the compact scheme
            style = {"color": colour, "marker": marker, "markersize": 4, "linewidth": 1.1}
            axes.loglog(curve.n, curve.value, label=label, **style)
        n = np.sort(there.n.unique())
        axes.set_xticks(n, map(str, n), fontsize=SMALL)
        axes.set_xticks([], minor=True)
        axes.yaxis.set_minor_formatter(NullFormatter())
        axes.set_title(surface, loc="left")
        axes.set_xlabel("n, of about n² vertices")
        axes.grid(True, **GRID)
    panels[0].set_ylabel(f"mean error of {quantity} ({QUANTITIES[quantity].unit})")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=4)
    return figure


@in_style
def cost_plot(accuracy, cost, peers) -> Figure:
    """Error over that of CGAL's fit against microseconds a vertex: the geometric mean over the
    jittered meshes that are held out, of K, at the second n; a staircase joins those that nothing
    beats in both."""
    n = sorted(accuracy.n.unique())[:2][-1]
    there = accuracy[(accuracy.kind == "jittered") & accuracy.held_out & (accuracy.n == n)]
    there = there[(there.place == "interior") & (there.quantity == "K")]
    ratio = np.exp(np.log(there.ratio).groupby(there.estimator).mean())
    micro = cost.set_index("method").microseconds
    names = [name for name in micro.index if name in ratio.index]
    theirs = dict(zip(peers.method, peers.label))
    figure = Figure(figsize=(TEXT_WIDTH, 3.6), layout="constrained")
    axes = figure.subplots()
    axes.set_xscale("log")
    axes.set_yscale("log")
    for number, name in enumerate(sorted(names, key=lambda x: (micro[x], ratio[x])), 1):
        stem, _, options = name.partition("(")
        plain = theirs.get(stem, name) + (f" ({options}" if options and stem in theirs else "")
        other = plain, "0.35" if stem in theirs else "#0077BB", "o"
        label, colour, marker = LOOKS.get(name, other)
        style = {"color": colour, "marker": marker, "markersize": 6, "linestyle": ""}
        axes.plot(micro[name], ratio[name], label=f"{number} {label}", **style)
        up = 5 if number % 2 else -10  # neighbours on the axis have numbers on two sides
        beside = {"xytext": (0, up), "textcoords": "offset points", "fontsize": SMALL}
        axes.annotate(str(number), (micro[name], ratio[name]), ha="center", **beside)
    best = sorted(names, key=lambda name: (micro[name], ratio[name]))
    front = [name for k, name in enumerate(best) if ratio[name] <= min(ratio[best[: k + 1]])]
    axes.step(micro[front], ratio[front], where="post", color="0.7", linewidth=0.8, zorder=0)
    axes.set_xlabel("processor time (microseconds a vertex)")
    axes.set_ylabel("error of K over that of CGAL's fit")
    axes.grid(True, **GRID)
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=SMALL)
    return figure


@in_style
def ablation_plot(jets, compact) -> Figure:
    """Error of K inside over that without the change, a marker per mesh: ablation tables."""
    figure = Figure(figsize=(TEXT_WIDTH, 4.6), layout="constrained")
    panels = figure.subplots(1, 2)
    rows = _ratios(jets[(jets.place == "interior") & (jets.quantity == "K")], "change")
    rows = [(f"{degree}: {WORDS[change]}", found) for (degree, change), found in rows]
    _dots(panels[0], rows, "jets")
    compact = compact[compact.quantity == "K"]
    last = compact[compact.change == "sweeps"].setting.max()
    base = compact[(compact.change == "sweeps") & (compact.setting == last)]
    base = base.set_index(["surface", "kind", "degree"]).value
    rows = []
    for (degree, change, setting), found in compact.groupby(["degree", "change", "setting"]):
        if setting not in (last, SLOPE, GAIN):
            own = found.set_index(["surface", "kind", "degree"]).value
            limit = "none" if setting > 1e6 else f"{setting:g}"
            rows.append((f"{degree}: {change} {limit}", own / base.reindex(own.index)))
    _dots(panels[1], rows, "compact scheme")
    return figure


def _ratios(table, column):
    """Of jets of the fewest rings, the errors of each change over those of none."""
    for degree, rings in ((4, 2), (6, 3)):
        there = table[(table.degree == degree) & (table.rings == rings)]
        base = there[there[column] == "none"].set_index(["surface", "kind"]).value
        for change in dict.fromkeys(there[column]):
            if change != "none":
                own = there[there[column] == change].set_index(["surface", "kind"]).value
                yield (degree, change), own / base.reindex(own.index)


def _dots(axes, rows, title):
    kinds = list(dict.fromkeys(key[:2] for _, found in rows for key in found.index))
    markers = dict(zip(kinds, MARKERS))
    for place, (_, found) in enumerate(rows):
        for key, x in found.items():
            style = {"markersize": 3.5, "linestyle": "", "color": "#332288", "alpha": 0.8}
            label = " ".join(key[:2][::-1]) if place == 0 else None
            axes.plot(x, place, markers[key[:2]], label=label, **style)
    axes.set_xscale("log")
    axes.axvline(1, color="0.5", linewidth=0.8)
    axes.set_yticks(range(len(rows)), [name for name, _ in rows], fontsize=SMALL - 1)
    axes.invert_yaxis()
    axes.set_title(title, loc="left")
    axes.set_xlabel("ratio of errors")
    axes.xaxis.set_major_formatter("{x:g}")
    axes.tick_params(axis="x", labelsize=SMALL)
    if axes.get_xlim()[1] < 10:
        axes.set_xticks([1, 1.5, 2, 2.5], minor=False)
        axes.minorticks_off()
    axes.grid(True, axis="x", **GRID)
    axes.legend(fontsize=SMALL - 0.5, loc="best")


@in_style
def where_plot(table) -> Figure:
    """Errors of K on the square of an open surface, seen from above, a panel per fit: map.csv, on
    one logarithmic scale."""
    names = list(dict.fromkeys(table.estimator))
    figure = Figure(figsize=(TEXT_WIDTH, 2.5), layout="constrained")
    panels = figure.subplots(1, len(names), sharex=True, sharey=True, squeeze=False)[0]
    logs = np.log10(np.maximum(table.error, 1e-16))
    low, high = np.percentile(logs, (1, 99.5))
    for axes, name in zip(panels, names):
        own = table[table.estimator == name]
        drawn = axes.scatter(
            own.x,
            own.y,
            c=np.log10(own.error),
            s=3,
            vmin=low,
            vmax=high,
            cmap="cividis",
            linewidths=0,
            rasterized=True,
        )
        axes.set_aspect("equal")
        axes.set_title(LOOKS[name][0], loc="left")
        axes.set_xticks([-1, 0, 1])
        axes.set_yticks([-1, 0, 1])
    figure.colorbar(drawn, ax=panels, label="log10 of the error of K", shrink=0.9)
    return figure
