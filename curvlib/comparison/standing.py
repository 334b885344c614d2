"""Where an estimator stands among others in a survey: ranks, and errors over the best."""

import numpy as np

PLACE = ["surface", "place", "quantity", "n"]


def ranked(table):
    """A survey with `rank` by mean error among the estimators of the same PLACE, 1 the best; NaN
    without a value."""
    return table.assign(rank=table.groupby(PLACE).value.rank(method="min"))


def beside_best(table, mine: str) -> list[dict]:
    """The rows of the estimator `mine` at the finest n of a ranked survey, each with the number of
    estimators `of` that have a value there, and the `best` of them with its `best_value`."""
    finest = table[table.n == table.n.max()]
    rows = []
    for _, same in finest.groupby(PLACE):
        own = same[same.estimator == mine]
        if len(own):
            best = same.sort_values(["rank", "estimator"]).iloc[0]
            known = {"best": best.estimator, "best_value": best.value}
            rows.append(own.iloc[0].to_dict() | {"of": int(same.value.notna().sum())} | known)
    return rows


def standing(table):
    """Per estimator (index) and quantity (columns): the geometric mean, over the surfaces, of its
    error at the finest n over the best, inside; NaN where it has no value on one of them.

    Ordered by K, then H.
    """
    inside = table[(table.n == table.n.max()) & (table.place == "interior")]
    errors = inside.pivot(index="estimator", columns=["quantity", "surface"], values="value")
    with np.errstate(divide="ignore"):
        over = np.log(errors / errors.min())
    mean = np.exp(over.T.groupby(level="quantity").mean().T)
    mean = mean.where(~over.isna().T.groupby(level="quantity").any().T)
    first = [q for q in ("K", "H", "k1", "k2", "d1") if q in mean]
    return mean[first].sort_values(first)
