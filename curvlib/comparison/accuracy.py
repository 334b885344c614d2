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
    """errors.csv: the rows of every reading; on meshes not `full`, those of readings with `more`.

    `readings`: reading, estimator, variant, counted, more.
    """
    table = readings.merge(rows, on=["estimator", "variant", "counted"])
    table = table[table.full | table.more]
    first = ["surface", "diagonal", "n", "triangles", "estimator", "reading", "quantity", "norm"]
    table = table.sort_values(first[:3] + first[4:], kind="stable")
    return table[[*first, "value", "vertices", "undefined"]]


def convergence(rows) -> pd.DataFrame:
    """One row per curve, by variant: the slope of log(mean error) over log(n) and what it says.

    `slope` by least squares over all resolutions, with its standard error `stderr` and, by
    leaving out one resolution after the other, `jackknife`; `tail` and `tail_stderr` are slope
    and standard error over the finest half (at least three), up to n = `finest`. Errors below
    `rounding` are no part of a fit. Verdicts: `exact` where at most one exceeds rounding, else
    by `tail`, which is -2 for an error of O(h^2): `converges` below -STAGNATION, `diverges`
    above it, `stagnates` between. Curves of one resolution are left out.
    """
    mean = rows[rows.norm == "mean"].sort_values("n")
    rises = mean.assign(rises=mean.groupby(CURVE).value.diff() >= 0).groupby(CURVE).rises.any()
    by_n = mean.set_index([*CURVE, "n"]).value.unstack("n")
    by_n = by_n[by_n.notna().sum(axis=1) > 1]
    curves = by_n.index.to_frame(index=False)
    levels = rounding_levels(rows)
    level = np.array([levels[key] for key in zip(curves.surface, curves.quantity)])

    value = by_n.to_numpy()
    use = value > level[:, None]
    x, y = np.log(by_n.columns.to_numpy(float)), np.log(np.where(use, value, 1))
    count = use.sum(1)
    # The finest half: of the points in use, those with few enough from there on.
    behind = use[:, ::-1].cumsum(1)[:, ::-1]
    tail = use & (behind <= np.maximum(3, (count + 1) // 2)[:, None])
    fits = dict(zip(("slope", "stderr"), slope_fit(x, y, use)))
    fits["jackknife"] = _jackknife(x, y, use)
    fits |= zip(("tail", "tail_stderr"), slope_fit(x, y, tail))
    fits["monotone"] = ~rises[by_n.index].to_numpy()
    fits["verdict"] = [verdict(t) if c > 1 else "exact" for t, c in zip(fits["tail"], count)]
    exists = by_n.notna().to_numpy()
    finest = by_n.columns.to_numpy()[exists.shape[1] - 1 - exists[:, ::-1].argmax(1)]
    return curves.assign(**fits, finest=finest, rounding=level)


def verdict(slope) -> str:
    """What a slope over log(n) says."""
    if abs(slope) < STAGNATION:
        return "stagnates"
    return "converges" if slope < 0 else "diverges"


def by_reading(rows, readings) -> pd.DataFrame:
    """convergence.csv: the curves of every reading, each over the meshes that it was run on."""
    key = ["estimator", "variant", "counted"]
    every, full = convergence(rows), convergence(rows[rows.full])
    more, others = readings[readings.more], readings[~readings.more]
    table = pd.concat([more.merge(every, on=key), others.merge(full, on=key)])
    first = ["surface", "diagonal", "estimator", "reading", "quantity"]
    table = table.sort_values(first, kind="stable").drop(columns=["variant", "counted", "more"])
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


def _jackknife(x, y, use):
    """Standard error of the slope from leaving out one point after the other; NaN for two."""
    without = use[:, None, :] & ~np.eye(use.shape[1], dtype=bool)
    slopes = slope_fit(x, y[:, None, :], without)[0]
    count = np.where(use.sum(1) > 2, use.sum(1), np.nan)
    mean = np.where(use, slopes, 0).sum(1) / count
    spread = np.where(use, slopes - mean[:, None], 0)
    return np.sqrt((count - 1) * (spread * spread).sum(1) / count)


def slope_fit(x, y, use):
    """Slopes of the least-squares lines through the points (..., n) that are in use, and their
    standard errors; NaN for less than two points, the error for less than three."""
    count = use.sum(-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        dx, dy = (use * (v - ((use * v).sum(-1) / count)[..., None]) for v in (x, y))
        square = (dx * dx).sum(-1)
        slope = (dx * dy).sum(-1) / square
        rest = dy - slope[..., None] * dx
        variance = (rest * rest).sum(-1) / np.where(count > 2, count - 2, np.nan)
        return slope, np.sqrt(variance / square)
