"""The claims by surface: yes, no or undecided."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from .style import in_lines, in_style

# These colours differ in lightness too.
VERDICTS = {"true": "#0072B2", "degenerate": "#E5E5E5", "undecided": "#999999", "false": "#D55E00"}


@in_style
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
    sentences = [in_lines(f"{c}. {sentences[c]}", 50) for c in verdicts.index]
    axes.set_yticks(np.arange(len(verdicts)) + 0.46, sentences, fontsize=8.2, linespacing=1.05)
    axes.xaxis.tick_top()
    labels = [modules[surface].LABEL for surface in verdicts.columns]
    middles = np.arange(len(labels)) + 0.47
    axes.set_xticks(middles, labels, rotation=40, ha="left", rotation_mode="anchor", fontsize=8)
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)
    return figure
