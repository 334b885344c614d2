"""Library functions against checks."""

from matplotlib.figure import Figure
from matplotlib.patches import Patch, Rectangle

from .style import SMALL, TEXT_WIDTH, in_style

# Colour and sign: told apart in grey, too.
LOOKS = {
    "pass": ("#B9DCEB", "✓"),
    "fail": ("#E69F00", "✗"),
    "not applicable": ("0.93", "·"),
    "not installed": ("white", ""),
}


@in_style
def conformance_plot(table) -> Figure:
    """A matrix of verdicts: a row for each function of conformance.csv, a column for each check."""
    checks = list(dict.fromkeys(table.check))
    functions = list(dict.fromkeys(table.function))
    labels = dict(zip(table.function, table.label))
    figure = Figure(figsize=(TEXT_WIDTH, 1.5 + 0.185 * len(functions)), layout="constrained")
    axes = figure.subplots()
    for row in table.itertuples():
        x, y = checks.index(row.check), functions.index(row.function)
        colour, sign = LOOKS[row.verdict]
        axes.add_patch(_cell(x, y, colour))
        axes.text(x, y, sign, ha="center", va="center", fontsize=SMALL)
    axes.set_xlim(-0.5, len(checks) - 0.5)
    axes.set_ylim(len(functions) - 0.5, -0.5)
    axes.xaxis.tick_top()
    axes.set_xticks(range(len(checks)), checks, rotation=50, ha="left", fontsize=SMALL)
    shown = [_short(labels[name]) for name in functions]
    axes.set_yticks(range(len(functions)), shown, fontsize=SMALL)
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    present = [v for v in LOOKS if (table.verdict == v).any()]
    handles = [Patch(facecolor=LOOKS[v][0], edgecolor="0.7", label=v) for v in present]
    figure.legend(handles=handles, loc="outside lower center", ncols=len(handles))
    return figure


def _cell(x, y, colour):
    return Rectangle((x - 0.5, y - 0.5), 1, 1, facecolor=colour, edgecolor="white", linewidth=1)


def _short(label):
    """A call in at most 44 letters, its beginning left out."""
    label = label.replace("compute_", "").replace("_per_vertex", "")
    return label if len(label) <= 44 else "…" + label[-43:]
