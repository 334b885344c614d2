"""Vertices per second of the estimators and their peers."""

import itertools

from matplotlib.figure import Figure

from curvlib.comparison.throughput import LIMITS

from .style import TEXT_WIDTH, in_style


@in_style
def throughput_plot(table, modules) -> Figure:
    """Vertices per second against vertices, one thread, log-log; a panel per kind of mesh.

    `modules`: the estimators' modules by name, for label and style; other methods are black.
    Grey lines are the LIMITS: arctangents alone, or one copy of the mesh.
    """
    kinds = list(dict.fromkeys(table.mesh))
    others = [m for m in dict.fromkeys(table.method) if m not in modules and m not in LIMITS]
    markers = dict(zip(others, itertools.cycle("x+*dPh")))
    styles = {m: {"color": "black", "linewidth": 0.8, "marker": markers[m]} for m in others}
    styles |= {name: module.STYLE | {"markersize": 4} for name, module in modules.items()}
    dashes = zip(LIMITS, itertools.cycle(("--", ":", "-.")))
    styles |= {limit: {"color": "0.5", "linestyle": dash} for limit, dash in dashes}
    labels = {name: module.LABEL for name, module in modules.items()}
    figure = Figure(figsize=(TEXT_WIDTH, 4.2), layout="constrained")
    panels = figure.subplots(1, len(kinds), sharey=True, squeeze=False)[0]
    for axes, kind in zip(panels, kinds):
        shown = table[(table.mesh == kind) & (table.threads == 1) & table.seconds.notna()]
        for method, curve in shown.groupby("method", sort=False):
            label = labels.get(method, method)
            axes.loglog(curve.vertices, curve.vertices_per_second, label=label, **styles[method])
        axes.set_title(f"{kind} torus", loc="left")
        axes.set_xlabel("vertices")
        axes.grid(True, which="major", color="0.9", linewidth=0.6)
    panels[0].set_ylabel("vertices per second, one thread")
    shown = (zip(*axes.get_legend_handles_labels()) for axes in panels)
    handles = {label: handle for pairs in shown for handle, label in pairs}
    figure.legend(handles.values(), handles, loc="outside lower center", ncols=3)
    return figure
