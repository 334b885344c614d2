"""How often errors are within one and two standard errors, by kind and level of noise."""

from matplotlib.figure import Figure

from .style import SMALL, TEXT_WIDTH, in_style

NOMINAL = 0.683, 0.954
# Of standard errors: marker, filled or not.
STYLES = {"within_1": ("o", "none"), "within_2": ("s", "full")}
COLOURS = {
    "white": "#0072B2",
    "isotropic": "#D55E00",
    "half": "#009E73",
    "correlated": "#CC79A7",
    "quantised": "#E69F00",
    "voxels": "#000000",
    "none": "#0072B2",
}
PANELS = (
    ("white noise", ("white",), "level", "level (mean edges)"),
    ("other noise", ("isotropic", "half", "correlated", "quantised", "voxels"), "level", None),
    ("exact vertices", ("none",), "n", "n (n² vertices)"),
)


@in_style
def coverage_plot(table, quantities=("K", "H")) -> Figure:
    """Parts of the vertices within one (circles) and two (squares) standard errors, the mean over
    surfaces, for one kind of noise with their range; grey: the nominal 68 and 95 %. `table`:
    coverage.csv."""
    shown = table.noise == "none"
    figure = Figure(figsize=(TEXT_WIDTH, 1.9 * len(quantities) + 0.5), layout="constrained")
    panels = figure.subplots(len(quantities), len(PANELS), sharey=True, squeeze=False)
    for row, quantity in zip(panels, quantities):
        of_quantity = table[table.quantity == quantity]
        for axes, (title, kinds, x, label) in zip(row, PANELS):
            for nominal in NOMINAL:
                axes.axhline(nominal, color="0.75", linewidth=0.8, zorder=0)
            for kind in kinds:
                _draw(axes, of_quantity[of_quantity.noise == kind], kind, x, len(kinds) == 1)
            axes.set_xscale("log")
            axes.set_ylim(0, 1.03)
            axes.tick_params(axis="y", labelsize=SMALL)
            if quantity == quantities[0]:
                axes.set_title(title, loc="left")
            if quantity == quantities[-1]:
                axes.set_xlabel(label or "level (mean edges; voxels: 1 / radius)", fontsize=8)
            if len(kinds) > 1 or x == "n":
                ticks = (0.01, 0.03, 0.1) if x == "level" else sorted(table[shown].n.unique())
                axes.set_xticks(ticks, map("{:g}".format, ticks), fontsize=SMALL)
                axes.minorticks_off()
        row[0].set_ylabel(f"{quantity}: part of the vertices", fontsize=8)
    # In panels that are empty below.
    one, two = panels[0, 0].lines[-2:]
    style = {"fontsize": SMALL, "handlelength": 1.2, "loc": "lower left"}
    panels[0, 0].legend((two, one), ("within 2 standard errors", "within 1"), **style)
    of_kinds = panels[0, 1].get_legend_handles_labels()
    panels[0, 2].legend(*of_kinds, title="other noise", title_fontsize=SMALL, **style)
    return figure


def _draw(axes, rows, kind, x, ranged):
    for column, (marker, fill) in STYLES.items():
        found = rows.groupby(x)[column].agg(["mean", "min", "max"])
        if found.empty:
            continue
        if ranged:
            style = {"color": COLOURS[kind], "alpha": 0.12, "linewidth": 0}
            axes.fill_between(found.index, found["min"], found["max"], **style)
        axes.plot(
            found.index,
            found["mean"],
            color=COLOURS[kind],
            marker=marker,
            fillstyle=fill,
            markersize=4,
            linewidth=1,
            label=kind if column == "within_2" else None,
        )
