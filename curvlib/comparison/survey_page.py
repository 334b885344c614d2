"""The survey of estimators as a page: what each sees, returns and costs, its errors and orders."""

import inspect
import re
from pathlib import Path

import numpy as np

from curvlib.catalogue import estimators

from .calls import calls
from .quantities import QUANTITIES

SURFACES = {
    "torus": "Torus, radii 2 and 0.7",
    "ellipsoid": "Ellipsoid, semi-axes 1, 0.8 and 0.6",
    "patch": "Open patch z = 0.5 x² - 0.3 y² + 0.15 sin(3 x) cos(2 y) over [-1, 1]²",
}


def page(table, names, cost=None) -> str:
    """Markdown of the survey.

    Parameters
    ----------
    table : DataFrame
        From `survey`.
    names : list of str
        Names or paths of the estimators.
    cost : DataFrame, optional
        throughput.csv; without it the page has no cost.

    Returns
    -------
    str
    """
    every = {str(call): call for call in calls(names)}
    n, finer = sorted(table.n.unique())[-2:]
    shown, finest = table[table.n == n], table[table.n == finer]
    parts = [
        "# The estimators",
        "Mean absolute errors on irregular meshes of n² vertices: a jittered grid and its Delaunay "
        f"triangles. In brackets the order from n = {n} to {finer}. K in 1/length², H, k1 and k2 "
        "in 1/length, the direction d1 in degrees, away from umbilics. An estimator without k1, k2 "
        "and d1 returns K and H alone. Options are the defaults but for those that are written.",
    ]
    for surface, words in SURFACES.items():
        inside = [t[(t.surface == surface) & (t.place == "interior")] for t in (shown, finest)]
        parts += [f"## {words}: n = {n}", _errors(*inside)]
    edge = finest[(finest.surface == "patch") & (finest.place == "boundary")]
    parts += [
        f"## At the boundary of the patch: n = {finer}",
        "The part of its vertices that have values, and their mean errors.",
        _boundary(edge),
        "## Neighbourhood" + ("" if cost is None else " and cost"),
    ]
    if cost is not None:
        parts.append(
            "On the largest irregular mesh in `throughput.csv`, one thread; the ratio is to "
            "libigl's `gaussian_curvature`, in the same process."
        )
    parts += [_reach(every, cost), "## Orders, as far as they are known", _known(every)]
    return "\n\n".join(parts) + "\n"


def _errors(shown, finest):
    value, order = _by_quantity(shown, "value"), _by_quantity(finest, "order")
    rows = [
        [name, *(_number(value[q][name], order[q][name]) for q in QUANTITIES)]
        for name in value.sort_values("K").index
    ]
    return _markdown(["estimator", *QUANTITIES], rows)


def _boundary(edge):
    value = _by_quantity(edge, "value")
    part = edge[edge.quantity == "K"].set_index("estimator").defined
    rows = [
        [name, f"{100 * part[name]:.0f} %", *(_number(value[q][name]) for q in QUANTITIES)]
        for name in value.sort_values("K").index
    ]
    return _markdown(["estimator", "defined", *QUANTITIES], rows)


def _by_quantity(table, column):
    found = table.pivot(index="estimator", columns="quantity", values=column)
    return found.reindex(columns=QUANTITIES)


def _reach(every, cost):
    head, rows = ["estimator", "neighbourhood"], [[n, c.neighbourhood] for n, c in every.items()]
    if cost is not None:
        head += ["µs a vertex", "ratio"]
        alone = cost[(cost.mesh == "irregular") & (cost.threads == 1) & cost.seconds.notna()]
        alone = alone.sort_values("vertices").drop_duplicates("method", keep="last")
        alone = alone.set_index("method")
        micro = (1e6 * alone.seconds / alone.vertices).reindex(every)
        ratio = alone.ratio.reindex(every)
        rows = [[*row, _digits(m), _digits(r)] for row, m, r in zip(rows, micro, ratio)]
    return _markdown(head, rows)


def _known(every):
    """The order that each docstring declares."""
    lines = []
    for name in dict.fromkeys(call.estimator for call in every.values()):
        words = inspect.getdoc(estimators.module(name).estimate) or ""
        found = re.search(r"Order: (.*?)(?:\n\n|$)", words, re.S)
        if found:
            lines.append(f"* `{Path(name).stem}`: {' '.join(found[1].split())}")
    return "\n".join(lines)


def _number(value, order=np.nan):
    if not np.isfinite(value):
        return ""
    digits = f"{value:.2g}" if value >= 0.01 else f"{value:.1e}"
    return digits + (f" ({order:z.1f})" if np.isfinite(order) else "")


def _digits(value):
    return f"{value:.2g}" if np.isfinite(value) else ""


def _markdown(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
