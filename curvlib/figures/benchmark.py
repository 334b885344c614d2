"""Figures of the benchmark: ranks as a matrix, error against cost, under noise, and against n."""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter, NullLocator

from .style import NO_RANK, SMALL, TEXT_WIDTH, in_lines, in_style

DEFAULT, OTHERS = "adaptive_fit", "0.82"
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
MARKERS = "osD^vP"
WORST = 100.0  # times the best, where the colours end
SHOWN = 9  # ranks that are written
ROW = 0.15  # inches


@in_style
def matrix(situations, labels) -> Figure:
    """Errors over the best as colours, and the first ranks as numbers: estimators by situations, a
    panel for each of K and H, estimators in the order of their mean.

    `situations`: situations.csv; `labels`: situation -> label, in order.
    """
    shown = [name for name in labels if name in set(situations.situation)]
    quantities = [q for q in ("K", "H") if q in set(situations.quantity)]
    every = situations[situations.quantity.isin(quantities)]
    over = every.pivot_table(
        index="estimator", columns=["quantity", "situation"], values="over_best"
    )
    # Missing values count as the worst, so that an estimator does not lead by leaving out.
    order = np.log(over.fillna(WORST).clip(upper=WORST)).mean(axis=1).sort_values().index
    height = ROW * len(order) + 1.5
    figure = Figure(figsize=(TEXT_WIDTH, height), layout="constrained")
    norm, colours = LogNorm(1, WORST), "viridis_r"
    panels = figure.subplots(1, len(quantities), sharey=True, squeeze=False)[0]
    for axes, quantity in zip(panels, quantities):
        own = every[every.quantity == quantity].set_index(["estimator", "situation"])
        values = own.over_best.unstack().reindex(index=order, columns=shown)
        ranks = own["rank"].unstack().reindex(index=order, columns=shown)
        axes.set_facecolor(NO_RANK["facecolor"])
        axes.pcolormesh(values.clip(upper=WORST), norm=norm, cmap=colours)
        for (y, x), rank in np.ndenumerate(ranks.to_numpy()):
            if rank <= SHOWN:
                dark = values.iloc[y, x] > np.sqrt(WORST)
                style = {"fontsize": SMALL - 1.5, "color": "white" if dark else "black"}
                axes.text(x + 0.5, y + 0.5, f"{rank:.0f}", ha="center", va="center", **style)
        axes.set_title(quantity, loc="left")
        names = [in_lines(labels[name], 24) for name in shown]
        axes.set_xticks(np.arange(len(shown)) + 0.5, names, rotation=90, fontsize=SMALL)
        axes.set_yticks(np.arange(len(order)) + 0.5, order, fontsize=SMALL)
        axes.tick_params(length=0)
        axes.spines[:].set_visible(False)
    panels[0].invert_yaxis()
    bar = figure.colorbar(ScalarMappable(norm, colours), ax=panels, aspect=40, fraction=0.03)
    bar.set_ticks([1, 10, 100], labels=["1", "10", "100 and more"])
    bar.ax.tick_params(labelsize=SMALL)
    bar.set_label("error over the best on a mesh", fontsize=SMALL)
    return figure


@in_style
def against_cost(situations, cost, labels, quantity: str = "H") -> Figure:
    """Error over the best against microseconds a vertex, in a panel for each situation; who is not
    beaten in both is joined and named.

    `cost`: cost.csv; others as for `matrix`.
    """
    price = cost.set_index("estimator").microseconds
    of = situations[(situations.quantity == quantity) & situations.over_best.notna()]
    shown = [name for name in labels if name in set(of.situation)]
    columns = min(3, len(shown))
    rows = -(-len(shown) // columns)
    figure = Figure(figsize=(TEXT_WIDTH, 1.9 * rows), layout="constrained")
    panels = figure.subplots(rows, columns, sharex=True, squeeze=False).ravel()
    for axes, name in zip(panels, shown):
        own = of[of.situation == name].set_index("estimator").over_best
        own = own[own.index.isin(price.index)]
        points = sorted((price[e], y, e) for e, y in own.items())
        front, best = [], np.inf
        for point in points:
            if point[1] < best:
                front.append(point)
                best = point[1]
        axes.loglog([p[0] for p in points], [p[1] for p in points], ".", color="0.6", ms=4)
        axes.loglog(*zip(*[p[:2] for p in front]), "o-", color=COLOURS[0], ms=3, lw=1)
        named = list(zip("abc", front[-3:]))
        for letter, (x, y, _) in named:
            style = {"textcoords": "offset points", "fontsize": SMALL - 1}
            axes.annotate(letter, (x, y), (2, 2), **style)
        said = "\n".join(f"{letter}  {point[2]}" for letter, point in named)
        axes.text(0.03, 0.03, said, fontsize=SMALL - 1.5, transform=axes.transAxes)
        if DEFAULT in own:
            axes.loglog(price[DEFAULT], own[DEFAULT], "s", color=COLOURS[1], ms=5, mfc="none")
        axes.set_ylim(0.15, min(own.max() * 1.5, 1e4))
        axes.set_title(labels[name], loc="left", fontsize=SMALL + 0.5)
        axes.tick_params(labelsize=SMALL)
    for axes in panels[len(shown) :]:
        axes.set_visible(False)
    figure.supxlabel("processor time, microseconds a vertex", fontsize=8)
    figure.supylabel(f"error of {quantity} over the best", fontsize=8)
    return figure


@in_style
def under_noise(errors, kinds, quantities=("K", "H"), first: int = 4) -> Figure:
    """Mean scaled error against the level, geometric mean of the surfaces, in a panel for each kind
    of noise and quantity; the best at some level and the default stand out.

    `errors`: errors.csv; `kinds`: those shown.
    """
    rows = errors[(errors.norm == "mean") & (errors.place == "interior")]
    rows = rows[rows.noise.isin(kinds) & rows.quantity.isin(quantities)]
    return _curves(rows, "noise", kinds, quantities, "level", "level, mean edges", first)


@in_style
def against_n(errors, families, labels, quantities=("K", "H"), first: int = 4) -> Figure:
    """Mean scaled error against the root of the number of vertices on clean meshes, in a panel for
    each family and quantity. `labels`: family -> label."""
    rows = errors[(errors.norm == "mean") & (errors.place == "interior")]
    rows = rows[(rows.noise == "none") & rows.family.isin(families)]
    words = "n, as in the plan"
    return _curves(rows, "family", families, quantities, "n", words, first, labels)


def _curves(rows, panel, names, quantities, x, words, first, labels=None):
    names = [name for name in names if (rows[panel] == name).any()]
    size = TEXT_WIDTH, 2.2 * len(quantities) + 0.6
    figure = Figure(figsize=size, layout="constrained")
    panels = figure.subplots(len(quantities), max(len(names), 1), sharex="col", squeeze=False)
    rows = rows[rows.undefined <= 0.05 * (rows.vertices + rows.undefined)]
    rows = rows.assign(log=np.log(rows.scaled.clip(lower=1e-12)))
    count = rows.groupby([panel, "quantity", x]).surface.transform("nunique")
    own_count = rows.groupby([panel, "quantity", x, "estimator"]).surface.transform("nunique")
    mean = rows[own_count == count].groupby([panel, "quantity", "estimator", x]).log.mean()
    tables = {
        (q, name): np.exp(mean.loc[name, q].unstack().dropna())
        for q in quantities
        for name in names
    }
    leaders = _leaders(tables.values(), first)
    for row, quantity in zip(panels, quantities):
        for axes, name in zip(row, names):
            table = tables[quantity, name]
            for estimator, values in table.iterrows():
                kind = {"color": OTHERS, "lw": 0.6, "zorder": 1}
                if estimator in leaders:
                    k = leaders.index(estimator)
                    kind = {"color": COLOURS[k], "marker": MARKERS[k], "ms": 3, "lw": 1.2}
                axes.loglog(values.index, values, **kind)
            low, high = table.min().min(), table.quantile(0.9).max()
            axes.set_ylim(low / 2, high * 2)
            axes.xaxis.set_minor_locator(NullLocator())
            if x == "n":
                axes.set_xticks(table.columns, table.columns)
            axes.tick_params(labelsize=SMALL)
            axes.yaxis.set_minor_formatter(NullFormatter())
            if quantity == quantities[0]:
                axes.set_title((labels or {}).get(name, name), loc="left")
        row[0].set_ylabel(f"error of {quantity}, scaled")
    for axes in panels[-1]:
        axes.set_xlabel(words)
    lines = [
        panels[0][0].plot([], [], color=COLOURS[k], marker=MARKERS[k], ms=3, label=name)[0]
        for k, name in enumerate(leaders)
    ]
    figure.legend(handles=lines, loc="outside lower center", ncols=3, fontsize=SMALL)
    return figure


def _leaders(tables, first):
    """The default, and who is the best beside it at most places, at most `first` of them."""
    wins = {}
    for table in tables:
        for estimator in table.drop(DEFAULT, errors="ignore").idxmin():
            wins[estimator] = wins.get(estimator, 0) + 1
    return [DEFAULT, *sorted(wins, key=lambda name: (-wins[name], name))[:first]]
