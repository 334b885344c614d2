"""Ranks of estimators over many meshes, by errors over the best on each mesh."""

import numpy as np
import pandas as pd

from .errors import MESH, NORMS

MESHES = list(MESH)
# An estimator with values at fewer of the vertices has no rank on a mesh.
COMPLETE = 0.9
# Scaled errors up to this are as good as none: a millionth of the largest curvature.
LEAST = 1e-6
# Errors up to this many times the best count as a win.
TIE = 1.1


def ranked(errors: pd.DataFrame, groups) -> pd.DataFrame:
    """Ranks in groups of meshes.

    Parameters
    ----------
    errors : DataFrame
        Rows of `curvlib.benchmark.errors.COLUMNS`.
    groups : list of str
        Columns; estimators are compared among rows with the same values there.

    Returns
    -------
    DataFrame
        Per group and `estimator`: `over_best`, the geometric mean over the group's meshes of its
        mean scaled error over the best on that mesh; `meshes`, on how many, and `of` how many
        anyone has a value; `wins`: the part of them where its mean error is within 10 % of the
        best; `rank` by `over_best`; `rank_median`, `rank_q95`, `rank_max` likewise by these norms;
        `rank_wins`; and `rank_low`, `rank_high`: the least and largest of these and of the ranks
        without each one of the surfaces. Only estimators with values at 90 % of the vertices of all
        meshes have ranks. Scaled errors are raised to 1e-6.
    """
    rows = []
    for labels, own in errors.groupby(groups, sort=False):
        labels = dict(zip(groups, labels if isinstance(labels, tuple) else (labels,)))
        rows += [labels | row for row in _rows(own)]
    return pd.DataFrame(rows)


def _rows(errors):
    of = {norm: _table(errors[errors.norm == norm]) for norm in NORMS}
    over = {norm: np.log(table.div(table.min(axis=1), axis=0)) for norm, table in of.items()}
    mean = over["mean"].dropna(how="all")
    surfaces = mean.index.get_level_values("surface")
    score = _score(mean)
    wins = (mean <= np.log(TIE)).sum() / max(len(mean), 1)
    ranks = {"rank": score.rank(method="min")}
    ranks |= {
        f"rank_{norm}": _score(over[norm].loc[mean.index]).rank(method="min") for norm in NORMS[1:]
    }
    ranks["rank_wins"] = wins.where(score.notna()).rank(method="min", ascending=False)
    others = []
    if surfaces.nunique() > 1:
        for surface in surfaces.unique():
            others.append(_score(mean[surfaces != surface]).where(score.notna()).rank(method="min"))
    every = pd.concat([*ranks.values(), *others], axis=1)
    table = pd.DataFrame({"over_best": np.exp(score), "meshes": mean.notna().sum(), "wins": wins})
    table = table.assign(of=len(mean), **ranks)
    table = table.assign(rank_low=every.min(axis=1), rank_high=every.max(axis=1))
    table.index.name = "estimator"
    return table.sort_values(["rank", "over_best"]).reset_index().to_dict("records")


def _table(errors):
    """Scaled errors: a row per mesh, a column per estimator; NaN where incomplete."""
    known = errors.vertices / (errors.vertices + errors.undefined) >= COMPLETE
    values = errors.scaled.clip(lower=LEAST).where(known)
    return errors.assign(scaled=values).pivot(index=MESHES, columns="estimator", values="scaled")


def _score(over):
    """The mean over meshes of log errors over the best; NaN without a value on each."""
    return over.mean().where(over.notna().all())
