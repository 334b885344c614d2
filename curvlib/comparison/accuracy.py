"""Accuracy of the estimates: errors by reading, orders of convergence, ranks."""

import numpy as np
import pandas as pd

from curvlib.errors import InputError

from .norms import NORMS, ROUNDING, VERTICES, rounding_level

VARIANT = ["estimator", "variant", "counted"]
CURVE = ["surface", "diagonal", *VARIANT, "quantity", "more"]

# |slope| below this is stagnation: half way from O(1) to O(h).
STAGNATION = 0.5

# Columns of text in the tables that jobs write; in the others stand numbers.
WORDS = ("surface", "diagonal", "estimator", "variant", "counted", "ring", "quantity")
# Columns of errors, empty where there is none.
ERRORS = (*NORMS, "value", "spread", "response", "response_spread")


def read(path) -> pd.DataFrame:
    """A table that an estimator's job wrote; InputError, naming the line, where it was damaged."""
    try:
        table = pd.read_csv(path)
    except (pd.errors.ParserError, pd.errors.EmptyDataError) as error:
        reason = f"no table ({str(error).strip()})"
        raise InputError(f"{path}: {reason}; delete it and run again") from None
    numbers = table.drop(columns=[c for c in WORDS if c in table])
    wrong = numbers.apply(pd.to_numeric, errors="coerce").isna() & numbers.notna()
    missing = table.drop(columns=[c for c in ERRORS if c in table]).isna()
    bad = wrong.any(axis=1) | missing.any(axis=1)
    if bad.any():
        line = int(bad.to_numpy().argmax()) + 2
        raise InputError(f"{path}: line {line} is damaged; delete the file and run again")
    return table


def by_variant(tables, readings, full, paper) -> pd.DataFrame:
    """variants.csv: the errors of all variants that a reading names, one row per quantity.

    `tables`: rows of `run_estimator`; `readings`: readings.csv; `full`: the MeshKeys on which
    every tabulated reading was run, `paper` those with the paper's resolutions and cut, marked in
    the columns of these names. On a surface without poles, rows are equal for all choices of
    vertices. Errors below `rounding` are rounding.
    """
    rows = concat(tables)
    everything, without_poles = VERTICES
    poles = set(rows.surface[rows.counted == without_poles])
    same = rows[(rows.counted == everything) & ~rows.surface.isin(poles)]
    rows = pd.concat([rows, same.assign(counted=without_poles)], ignore_index=True)
    rows = rows.merge(readings[VARIANT].drop_duplicates(), on=VARIANT)
    largest = rows.groupby("surface").largest_k.max()
    level = {
        (s, q): rounding_level(q, largest[s]) for s in largest.index for q in set(rows.quantity)
    }
    full, paper = set(full), set(paper)
    keys = list(zip(rows.surface, rows.diagonal, rows.n))
    return rows.assign(
        paper=[key in paper for key in keys],
        full=[key in full for key in keys],
        rounding=[level[key] for key in zip(rows.surface, rows.quantity)],
    ).drop(columns="largest_k")


def errors(rows, readings) -> pd.DataFrame:
    """errors.csv: the errors of every reading, a row per norm; on meshes that are not `full`, of
    readings with `more`."""
    table = readings.merge(rows, on=VARIANT)
    table = table[table.full | table.more]
    key = ["surface", "diagonal", "n", "triangles", "estimator", "reading", "quantity"]
    table = table.sort_values(key[:3] + key[4:], kind="stable", ignore_index=True)
    norms = sorted(NORMS)
    long = table.loc[table.index.repeat(len(norms)), [*key, "vertices", "undefined"]]
    long.insert(len(key), "norm", norms * len(table))
    long.insert(len(key) + 1, "value", table[norms].to_numpy().ravel())
    return long


def curves(rows, readings) -> pd.DataFrame:
    """curves.csv, from variants.csv: convergence of the mean error of each variant.

    `more`: false for curves over the full meshes, true for curves over all meshes, which readings
    with `more` use. `slope` of log(error) over log(n) by least squares over all resolutions, with
    its standard error `stderr` and its jackknife standard error `jackknife`; `tail`: the slope over
    the finest half of the resolutions (at least three), up to n = `finest`; `order`, `order_low`,
    `order_high`: see `local_orders`, over the same half. Errors below `rounding` are left out.
    `verdict` is decided by `tail`. Curves of one resolution are left out.
    """
    everywhere = rows.merge(readings.loc[readings.more, VARIANT].drop_duplicates(), on=VARIANT)
    rows = pd.concat([rows[rows.full].assign(more=False), everywhere.assign(more=True)])
    rows = rows.sort_values("n")
    rises = rows.assign(rises=rows.groupby(CURVE)["mean"].diff() >= 0).groupby(CURVE).rises.any()
    by_n = rows.set_index([*CURVE, "rounding", "n"])["mean"].unstack("n")
    by_n = by_n[by_n.notna().sum(axis=1) > 1].reset_index("rounding")
    level = by_n.pop("rounding").to_numpy()

    n, value = by_n.columns.to_numpy(float), by_n.to_numpy(float)
    use = value > level[:, None]
    x, y = np.log(n), np.log(np.where(use, value, 1))
    count = use.sum(1)
    # A point is in the finest half if few enough of the points in use are as fine.
    behind = use[:, ::-1].cumsum(1)[:, ::-1]
    tail = use & (behind <= np.maximum(3, (count + 1) // 2)[:, None])
    fits = dict(zip(("slope", "stderr"), slope_fit(x, y, use)))
    fits["jackknife"] = _jackknife(x, y, use)
    fits["tail"], _ = slope_fit(x, y, tail)
    fits |= local_orders(x, y, tail)
    fits["monotone"] = ~rises[by_n.index].to_numpy()
    fits["verdict"] = verdicts(fits["tail"], value, use)
    exists = by_n.notna().to_numpy()
    finest = by_n.columns.to_numpy()[exists.shape[1] - 1 - exists[:, ::-1].argmax(1)]
    return by_n.index.to_frame(index=False).assign(**fits, finest=finest, rounding=level)


def verdicts(slopes, values, use) -> list[str]:
    """Verdicts on slopes over log(n) (m,) of errors (m, n); those in `use` exceed rounding.

    `undefined` without any error, `exact` where at most one exceeds rounding, else by slope (-2
    for an error of O(h^2)): `converges` below -STAGNATION, `diverges` above STAGNATION, `stagnates`
    between.
    """
    chosen = [np.isnan(values).all(1), use.sum(1) < 2, slopes < -STAGNATION, slopes > STAGNATION]
    names = ["undefined", "exact", "converges", "diverges"]
    found = np.select([*chosen, np.isfinite(slopes)], [*names, "stagnates"], "undefined")
    return found.tolist()


def convergence(curves, readings) -> pd.DataFrame:
    """convergence.csv: the curves of every reading, over the meshes on which it was run."""
    table = readings.merge(curves, on=[*VARIANT, "more"])
    first = ["surface", "diagonal", "estimator", "reading", "quantity"]
    table = table.sort_values(first, kind="stable")
    return table[[*first, *curves.columns.difference([*first, *CURVE], sort=False)]]


def ring_slopes(rings) -> pd.DataFrame:
    """rings.csv: per valence, kind of ring, quantity, estimator and variant the slope of
    log(mean error) over log(1/h) on the smaller half of the sizes, its standard error, verdict, and
    `local_orders`."""
    key = ["valence", "ring", "quantity", "estimator", "variant"]
    by_h = rings.set_index([*key, "h"]).value.unstack("h")
    by_h = by_h.iloc[:, : (len(by_h.columns) + 1) // 2]
    value = by_h.to_numpy(float)
    # The quadrics are drawn with principal curvatures up to 1.
    level = [rounding_level(quantity, 1.0) for quantity in by_h.index.get_level_values("quantity")]
    use = value > np.reshape(level, (-1, 1))
    x, y = -np.log(by_h.columns.to_numpy(float)), np.log(np.where(use, value, 1))
    slope, stderr = slope_fit(x, y, use)
    fits = {"slope": slope, "stderr": stderr, "verdict": verdicts(slope, value, use)}
    fits |= local_orders(x[::-1], y[:, ::-1], use[:, ::-1])
    return by_h.index.to_frame(index=False).assign(**fits)


def ranks(errors, rows) -> pd.DataFrame:
    """ranks.csv, from errors.csv and, for the rounding levels, variants.csv: 1 for the smallest
    mean error. An error within rounding of the next smaller one shares its rank. An estimator
    whose mean is over fewer vertices than another's has none: it may not gain by failing."""
    group = ["surface", "diagonal", "n", "reading", "quantity"]
    mean = errors[(errors.norm == "mean") & errors.value.notna()]
    mean = mean[mean.vertices == mean.groupby(group).vertices.transform("max")]
    mean = mean.sort_values([*group, "value", "estimator"], kind="stable")
    levels = rows.groupby(["surface", "quantity"]).rounding.first()
    level = levels.reindex(pd.MultiIndex.from_frame(mean[["surface", "quantity"]])).to_numpy()
    before = mean.groupby(group, sort=False).value.shift()
    starts = ~(mean.value <= before + np.maximum(level, ROUNDING * before))
    place = mean.groupby(group, sort=False).cumcount() + 1
    rank = place.where(starts).ffill().astype(int)
    return mean[[*group, "estimator", "value"]].assign(rank=rank)


def local_orders(x, y, use) -> dict:
    """Orders of convergence of errors exp(y) (m, r) at x (r,) = log(n) ascending, where in `use`.

    `order`: that from the first to the last point, log(e_1 / e_2) / log(n_2 / n_1); `order_low` and
    `order_high`: the least and the largest between neighbouring points. NaN for fewer than three
    points, whose one order has no range.
    """
    before, first = np.full((2, 2, len(y)), np.nan)
    low, high = np.full(len(y), np.inf), np.full(len(y), -np.inf)
    for j, at in enumerate(use.T):
        here = np.where(at, [np.broadcast_to(x[j], len(y)), y[:, j]], np.nan)
        with np.errstate(divide="ignore", invalid="ignore"):
            p = (before[1] - here[1]) / (here[0] - before[0])
        low, high = np.fmin(low, p), np.fmax(high, p)
        first = np.where(np.isnan(first), here, first)
        before = np.where(at, here, before)
    enough = use.sum(1) > 2
    with np.errstate(divide="ignore", invalid="ignore"):
        order = (first[1] - before[1]) / (before[0] - first[0])
    found = {"order": order, "order_low": low, "order_high": high}
    return {name: np.where(enough, values, np.nan) for name, values in found.items()}


def concat(tables) -> pd.DataFrame:
    """Concatenate tables; a row that two have counts once. Those without rows are left out, since
    they lack column types."""
    tables = list(tables)
    found = pd.concat([t for t in tables if len(t)] or tables[:1], ignore_index=True)
    return found.drop_duplicates(ignore_index=True)


def _jackknife(x, y, use):
    """Jackknife standard error of the slope; NaN for fewer than three points."""
    without = use[:, None, :] & ~np.eye(use.shape[1], dtype=bool)
    slopes = slope_fit(x, y[:, None, :], without)[0]
    count = np.where(use.sum(1) > 2, use.sum(1), np.nan)
    mean = np.where(use, slopes, 0).sum(1) / count
    spread = np.where(use, slopes - mean[:, None], 0)
    return np.sqrt((count - 1) * (spread * spread).sum(1) / count)


def slope_fit(x, y, use):
    """Slopes of the least-squares lines through the points (..., n) in use, NaN for fewer than two,
    and their standard errors, NaN for fewer than three."""
    count = use.sum(-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        dx, dy = (use * (v - ((use * v).sum(-1) / count)[..., None]) for v in (x, y))
        square = (dx * dx).sum(-1)
        slope = (dx * dy).sum(-1) / square
        rest = dy - slope[..., None] * dx
        variance = (rest * rest).sum(-1) / np.where(count > 2, count - 2, np.nan)
        return slope, np.sqrt(variance / square)
