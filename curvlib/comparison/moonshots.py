"""What was tried beyond the estimators that there are, with what came of it."""

import numpy as np
import pandas as pd

from curvlib.estimation import estimate
from curvlib.meshes.noise import noisy

from .adaptive import fixed
from .boundary import LAYERS
from .hessians import hessians
from .references import principal_axes


def seconds(meshes, degrees=(6, 7, 8), threads: int = 1) -> pd.DataFrame:
    """hessians.csv: the prototype with second derivatives as unknowns.

    Parameters
    ----------
    meshes : dict
        (surface, kind, n) -> closed Mesh with exact K and H.
    degrees : sequence of int
    threads : int

    Returns
    -------
    DataFrame
        Per mesh, `degree` and quantity the mean error `value`, its `ratio` to that of CGAL's fit,
        `over_compact` to that of `compact_hermite`, the number of `sweeps`, and their mean `rate`.
    """
    rows = []
    for key, mesh in meshes.items():
        theirs = estimate(mesh, principal_axes, threads, degree=4, rings=3)
        ours = estimate(mesh, "compact_hermite", threads)
        for degree in degrees:
            K, H, changes = hessians(mesh, degree, threads=threads)
            rate = (changes[-1] / changes[len(changes) // 2]) ** (1 / (len(changes) // 2))
            for name, found in (("K", K), ("H", H)):
                exact = getattr(mesh, name)
                own, *others = (
                    np.nanmean(np.abs(x - exact))
                    for x in (found, getattr(theirs, name), getattr(ours, name))
                )
                labels = dict(zip(("surface", "kind", "n"), key)) | {"degree": degree}
                row = {"quantity": name, "value": own, "ratio": own / others[0]}
                row |= {"over_compact": own / others[1], "sweeps": len(changes), "rate": rate}
                rows.append(labels | row)
    return pd.DataFrame(rows)


def halves(meshes, levels, seed: int, threads: int = 1) -> pd.DataFrame:
    """half.csv: where noise lies on one half, `adaptive_fit` beside the best pair of fixed fits,
    one for each half.

    Returns
    -------
    DataFrame
        Per mesh, `level` of noise in mean edges and quantity the mean error `value` inside, the
        `ratio` to that of the best pair, and to the best `single` fixed fit.
    """
    rows = []
    for key, mesh in meshes.items():
        inside = ~mesh.boundary
        rough = (mesh.vertices[:, 0] > np.median(mesh.vertices[:, 0]))[inside]
        for level in levels:
            moved = noisy(mesh, "half", level, seed)
            every = [
                estimate(moved, name, threads, **options)
                for name, options in (("adaptive_fit", {}), *fixed())
            ]
            for name in ("K", "H"):
                exact = getattr(mesh, name)
                own, *errors = (np.abs(getattr(x, name) - exact)[inside] for x in every)
                quiet, loud = (min(np.nansum(e[part]) for e in errors) for part in (~rough, rough))
                value, single = np.nanmean(own), min(np.nanmean(e) for e in errors)
                row = dict(zip(("surface", "kind", "n"), key)) | {"level": level, "quantity": name}
                row |= {"value": value, "ratio": value / ((quiet + loud) / len(own))}
                rows.append(row | {"single": value / single})
    return pd.DataFrame(rows)


def moonshots(second, half, contraction, boundary, cost) -> pd.DataFrame:
    """moonshots.csv: `moonshot`, `aim` in words, `limit`, `measured`, whether it is `met`.

    Parameters
    ----------
    second, half, contraction, boundary, cost : DataFrame
        From `seconds`, `halves`, `contraction`, `boundary` and `cost`.
    """
    rows = []

    def row(moonshot, aim, limit, measured, met):
        found = {"moonshot": moonshot, "aim": aim, "limit": limit, "measured": measured}
        rows.append(found | {"met": bool(met)})

    top = second[second.degree == second.degree.max()]
    coarse = top[top.n == top.n.min()].ratio.max()
    row("second derivatives as data", "error over CGAL's", 1 / 1000, coarse, coarse <= 1 / 1000)
    span = np.log(top.n.max() / top.n.min()) if top.n.nunique() > 1 else np.nan
    ends = [
        top[top.n == n].set_index(["surface", "quantity"]).value for n in (top.n.min(), top.n.max())
    ]
    order = (np.log(ends[0] / ends[1]) / span).min()
    row("second derivatives as data", "order", 6, order, order >= 6)
    own = cost[(cost.method == "compact_hermite")].iloc[0]
    if own.reference.startswith("libigl"):
        row("degree 6 compact", "cost over libigl's", 12, own.ratio, own.ratio <= 12)
    at_edge = boundary[(boundary.layer == 0) & (boundary.estimator == "settled")]
    inner = boundary[(boundary.layer == LAYERS) & (boundary.estimator == "compact_hermite")]
    same = ["surface", "kind", "n", "quantity"]
    over = (at_edge.set_index(same).value / inner.set_index(same).value).max()
    row("accuracy up to the boundary", "error there over that inside", 1, over, over <= 1)
    worst = half.ratio.max()
    row("noise that jumps", "error over the best pair's", 1.2, worst, worst <= 1.2)
    six = contraction[contraction.degree == 6].bound.max()
    row("contraction", "certified bound of degree 6", 1, six, six < 1)
    return pd.DataFrame(rows)
