"""Vertices per second of the estimators and their peers."""

import itertools

from matplotlib.figure import Figure

from curvlib.comparison.throughput import LIMITS

from .style import TEXT_WIDTH, in_style

# Of an estimator's calls with options, which share its colour and marker.
DASHES = ("-.", ":", (0, (5, 1, 1, 1, 1, 1)))


@in_style
def throughput_plot(table, modules) -> Figure:
    """Vertices per second against vertices, one thread, log-log; a panel per kind of mesh.

    `modules`: the estimators' modules by name, for label and style; other methods are black. A
    method is an estimator's if it is `name` or `name(options)`.
    Grey lines are the LIMITS: arctangents alone, or one copy of the mesh.
    """
    kinds = list(dict.fromkeys(table.mesh))
    methods = [m for m in dict.fromkeys(table.method) if m not in LIMITS]
    others = [m for m in methods if _estimator(m) not in modules]
    markers = dict(zip(others, itertools.cycle("x+*dPh")))
    styles = {m: {"color": "black", "linewidth": 0.8, "marker": markers[m]} for m in others}
    labels = {}
    for name, module in modules.items():
        ours = [m for m in methods if _estimator(m) == name]
        for method, own in zip(ours, itertools.cycle(({}, *({"linestyle": d} for d in DASHES)))):
            styles[method] = module.STYLE | {"markersize": 4} | own
            labels[method] = module.LABEL + method.removeprefix(name).replace("(", " (")
    dashes = zip(LIMITS, itertools.cycle(("--", ":", "-.")))
    styles |= {limit: {"color": "0.5", "linestyle": dash} for limit, dash in dashes}
    figure = Figure(figsize=(TEXT_WIDTH, 5.4), layout="constrained")
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


def _estimator(method):
    """The estimator of a call, `jet` of `jet(degree=3)`."""
    return method.partition("(")[0]
