"""How far estimates are from the exact values: errors by reading, convergence, ranks."""

import numpy as np
import pandas as pd

from .norms import ROUNDING, VERTICES

CURVE = ["surface", "diagonal", "estimator", "variant", "counted", "quantity"]

# |slope| below this, nearer to no order of convergence than to the first, is stagnation.
STAGNATION = 0.5


def by_variant(tables, full) -> pd.DataFrame:
    """The errors of all estimators, one row per variant and choice of vertices.

    `tables`: one DataFrame per estimator, of `results.run_estimator`. `full`: the (diagonal, n)
    on which all variants were run, marked in the column `full`. A surface without poles has
    the same rows for every choice of vertices.
    """
    rows = pd.concat(tables, ignore_index=True)
    _, without_poles = VERTICES
    poles = set(rows.surface[rows.counted == without_poles])
    same = rows[~rows.surface.isin(poles)].assign(counted=without_poles)
    rows = pd.concat([rows, same], ignore_index=True)
    return rows.assign(full=[mesh in full for mesh in zip(rows.diagonal, rows.n)])


def rounding_levels(rows) -> dict:
    """(surface, quantity) -> the error below which nothing but rounding is left."""
    largest = rows.groupby("surface").largest_k.max()
    return {(s, q): ROUNDING * k**p for s, k in largest.items() for q, p in (("K", 2), ("H", 1))}


def errors(rows, readings) -> pd.DataFrame:
    """errors.csv: the rows of every reading; on meshes not `full` those of the default alone.

    `readings`: reading, estimator, variant, counted.
    """
    table = readings.merge(rows, on=["estimator", "variant", "counted"])
    table = table[table.full | (table.reading == "default")]
    first = ["surface", "diagonal", "n", "triangles", "estimator", "reading", "quantity", "norm"]
    table = table.sort_values(first[:3] + first[4:], kind="stable")
    return table[[*first, "value", "vertices", "undefined"]]


def convergence(rows) -> pd.DataFrame:
    """One row per curve, by variant: the slope of log(mean error) over log(n) and what it says.

    `slope` by least squares over all resolutions, with its standard error `stderr` and, by
    leaving out one resolution after the other, `jackknife`; `tail` and `tail_stderr` are slope
    and standard error over the finest half (at least three). Errors below `rounding` are no
    part of a fit. Verdicts: `exact` where nothing exceeds rounding, else by `tail`, which is -2
    for an error of O(h^2): `converges` below -STAGNATION, `diverges` above it, `stagnates`
    between. Curves of one resolution are left out.
    """
    levels, result = rounding_levels(rows), []
    mean = rows[rows.norm == "mean"].sort_values("n")
    for curve, points in mean.groupby(CURVE, sort=False):
        if len(points) < 2:
            continue
        labels = dict(zip(CURVE, curve))
        level = levels[labels["surface"], labels["quantity"]]
        n, value = points.n.to_numpy(float), points.value.to_numpy()
        x, y = np.log(n[value > level]), np.log(value[value > level])
        fit = {"verdict": "exact"}
        if len(x) > 1:
            fit = _fits(x, y)
            fit["verdict"] = verdict(fit["tail"])
        result.append(
            labels | fit | {"monotone": bool((np.diff(value) < 0).all()), "rounding": level}
        )
    columns = ["slope", "stderr", "jackknife", "tail", "tail_stderr", "monotone", "verdict"]
    return pd.DataFrame(result, columns=[*CURVE, *columns, "rounding"])


def verdict(slope) -> str:
    """What a slope over log(n) says."""
    if abs(slope) < STAGNATION:
        return "stagnates"
    return "converges" if slope < 0 else "diverges"


def by_reading(curves, readings) -> pd.DataFrame:
    """convergence.csv: the curves of every reading."""
    table = readings.merge(curves, on=["estimator", "variant", "counted"])
    first = ["surface", "diagonal", "estimator", "reading", "quantity"]
    table = table.sort_values(first, kind="stable").drop(columns=["variant", "counted"])
    return table[[*first, *table.columns.difference(first, sort=False)]]


def ranks(table, levels) -> pd.DataFrame:
    """ranks.csv, from errors.csv: 1 for the smallest mean error; what differs from the next
    smaller one by rounding shares its rank."""
    group = ["surface", "diagonal", "n", "reading", "quantity"]
    mean = table[table.norm == "mean"].sort_values([*group, "value", "estimator"], kind="stable")
    level = [levels[key] for key in zip(mean.surface, mean.quantity)]
    before = mean.groupby(group, sort=False).value.shift()
    starts = ~(mean.value <= before + np.maximum(level, ROUNDING * before))
    place = mean.groupby(group, sort=False).cumcount() + 1
    rank = place.where(starts).ffill().astype(int)
    return mean[[*group, "estimator", "value"]].assign(rank=rank)


def _fits(x, y):
    half = max(3, (len(x) + 1) // 2)
    slope, stderr = slope_fit(x, y)
    left_out = [slope_fit(np.delete(x, i), np.delete(y, i))[0] for i in range(len(x)) if len(x) > 2]
    spread = np.sqrt((len(x) - 1) * np.var(left_out)) if left_out else np.nan
    tail, tail_stderr = slope_fit(x[-half:], y[-half:])
    names = ("slope", "stderr", "jackknife", "tail", "tail_stderr")
    return dict(zip(names, (slope, stderr, spread, tail, tail_stderr)))


def slope_fit(x, y):
    """Slope of the least-squares line and its standard error (NaN for two points)."""
    dx = x - x.mean()
    slope = (dx * y).sum() / (dx * dx).sum()
    rest = y - y.mean() - slope * dx
    freedom = len(x) - 2
    variance = (rest * rest).sum() / freedom if freedom else np.nan
    return slope, np.sqrt(variance / (dx * dx).sum())
