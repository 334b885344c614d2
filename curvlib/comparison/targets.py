"""What was aimed at, before the estimators were written, and what is measured."""

import numpy as np
import pandas as pd

COMPACT, FOUR, JET = "compact_hermite", "compact_hermite(degree=4)", "jet(degree=6, rings=3)"
# Errors are those on meshes of about 50^2 vertices.
N = 50
WITHIN = 1.1  # times the floor of a sphere of voxels


def targets(accuracy, cost, adaptive, voxel) -> pd.DataFrame:
    """targets.csv: a row for each aim.

    Parameters
    ----------
    accuracy, cost, adaptive, voxel : DataFrame
        accuracy.csv, cost.csv, adaptive-ratios.csv, voxel.csv.

    Returns
    -------
    DataFrame
        `estimator`, `aim` in words, `sense` (`most` or `least`), `limit`, `measured`: the worst of
        all cases that the aim names; whether it is `met`; `cases`. Ratios of errors are to
        the fit of CGAL; of K and H, on surfaces seen and held out. Cost has a row where
        it was measured against libigl.
    """
    n = min(accuracy.n.unique(), key=lambda x: abs(x - N))
    of_forms = accuracy[accuracy.quantity.isin(["K", "H"])]
    inside, edge = (of_forms[of_forms.place == place] for place in ("interior", "boundary"))
    jittered = inside[inside.kind == "jittered"]
    closed, finest = jittered[jittered.closed], jittered[jittered.n == jittered.n.max()]
    at_n = {name: t[t.n == n] for name, t in (("closed", closed), ("all", jittered))}
    orders = {name: t for name, t in (("closed", finest[finest.closed]), ("all", finest))}

    def of(table, estimator, column="ratio"):
        return table[table.estimator == estimator][column]

    rows = [
        (JET, "error over CGAL's, jittered meshes", "most", 1 / 15, of(at_n["all"], JET)),
        (JET, "order, jittered meshes", "least", 4.8, of(orders["all"], JET, "order")),
        (JET, "error over CGAL's on the boundary", "most", 1 / 3, of(edge[edge.n == n], JET)),
        (JET, "part of the boundary defined", "least", 1, of(edge, JET, "defined")),
        (JET, "cost over libigl's", "most", 16, _cost(cost, JET)),
        (
            COMPACT,
            "error over CGAL's, closed jittered meshes",
            "most",
            1 / 80,
            of(at_n["closed"], COMPACT),
        ),
        (
            COMPACT,
            "order, closed jittered meshes",
            "least",
            5,
            of(orders["closed"], COMPACT, "order"),
        ),
        (COMPACT, "cost over libigl's", "most", 24, _cost(cost, COMPACT)),
        (
            FOUR,
            "error over CGAL's, closed jittered meshes",
            "most",
            1 / 12,
            of(at_n["closed"], FOUR),
        ),
        (FOUR, "order, closed jittered meshes", "least", 3, of(orders["closed"], FOUR, "order")),
        (FOUR, "cost over libigl's", "most", 10, _cost(cost, FOUR)),
        (COMPACT, "angle of d1 on the torus, degrees", "most", 0.01, _angle(accuracy, n)),
        *_voxels(voxel),
    ]
    white = adaptive.noise == "white"
    own = "adaptive_fit"
    rows += [
        (
            own,
            "mean ratio to the best fixed fit, white noise",
            "most",
            1.2,
            adaptive[white]["mean"],
        ),
        (own, "worst ratio, white noise", "most", 2, adaptive[white].worst),
        (own, "mean ratio, other noise", "most", 1.5, adaptive[~white]["mean"]),
        (own, "worst ratio, other noise", "most", 3, adaptive[~white].worst),
        (own, "cost over libigl's, exact vertices", "most", 30, _cost(cost, own)),
    ]
    found = [_row(*row) for row in rows if len(row[-1])]
    return pd.DataFrame(found)


def _row(estimator, aim, sense, limit, values):
    worst = values.max() if sense == "most" else values.min()
    met = worst <= limit if sense == "most" else worst >= limit
    row = {"estimator": estimator, "aim": aim, "sense": sense, "limit": limit}
    return row | {"measured": worst, "met": bool(met), "cases": len(values)}


def _cost(cost, method):
    return cost[(cost.method == method) & cost.reference.str.startswith("libigl")].ratio


def _angle(accuracy, n):
    there = accuracy[(accuracy.surface == "torus") & (accuracy.quantity == "d1")]
    return there[(there.n == n) & (there.estimator == COMPACT)].value


def _voxels(voxel):
    """Of the radius with the widest published support, beside the best published row."""
    ours = voxel[(voxel.method == "ball_regression")]
    widest = ours.groupby("mesh").radius_hit.transform("max")
    ours = ours[ours.radius_hit == widest]
    best = voxel[voxel.published].groupby(["mesh", "quantity"]).error.min()
    theirs = best.reindex(pd.MultiIndex.from_frame(ours[["mesh", "quantity"]])).to_numpy()
    over = np.minimum(ours.error / theirs, ours.error / (WITHIN * ours.floor))
    aim = "error over the better of the published and 1.1 of the floor"
    name = "ball_regression"
    yield name, f"spheres of voxels: {aim}", "most", 1, over
    yield name, "spheres of voxels: spread about the fitted sphere", "most", 0.01, ours.spread
