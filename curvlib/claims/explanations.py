"""What explains 2003: the joint reading under which most of the paper's ranking comes back."""

import pandas as pd

from .cell import SEVEN, Holds
from .evidence import COLUMNS, FINE, Evidence

BEST = "best-explanation"

# The paper's ranking, by n: best for K, best for H, second for K. What it concludes from them
# (claims 3, 10, 11) would count them twice.
RANKING = (1, 2, 6)

# How many decisions of the printed text a value departs from; the values not named, none.
DEPARTURES = {
    # (3.3), the plain mean
    "normal": {"area": 1, "exact": 1},
    # "the angle is close to pi"
    "pairs": {"above-90": 1, "all": 1},
    # (3.12) has A/2, (3.13) has A/3
    "area": {"third": 1, "mixed": 2},
    # (3.13), angle(N_i, N_i+1) times |e_i|
    "dihedral": {"signed": 1, "unsigned": 1},
}


def explain(readings, variants, curves) -> pd.DataFrame:
    """explanations.csv: a row per joint reading and claim, on the paper's meshes.

    Parameters
    ----------
    readings, variants, curves : DataFrame
        The tables of these names. Searched are the readings of the kind `product`.

    Returns
    -------
    DataFrame
        A column per option; `claim`; on how many surfaces the claim holds `at_finest`, `from_24`
        (at every n >= 24) and `always`, on how many it is `degenerate`, `of` how many in all;
        `departures` of the reading from the printed text; its `score`: the sum of `at_finest`,
        `from_24` and `always` over the claims of RANKING, less its departures.
    """
    evidence = Evidence(variants[variants.paper & variants.surface.isin(SEVEN)], curves)
    joint = readings[readings.kind == "product"]
    found = []
    for name, reading in joint.groupby("reading", sort=False):
        options = dict(choice.split("=") for choice in name.split(","))
        rows = pd.DataFrame(evidence.rows(reading), columns=COLUMNS)
        counts = [_counts(number, of_claim) for number, of_claim in rows.groupby("claim")]
        ranking = [row for row in counts if row["claim"] in RANKING]
        about = {"departures": departures(options)}
        about["score"] = sum(row[level] for row in ranking for level in LEVELS)
        about["score"] -= about["departures"]
        found += [options | row | about for row in counts]
    return pd.DataFrame(found, columns=None if found else ["claim", *LEVELS, "score"])


LEVELS = ("at_finest", "from_24", "always")


def _counts(number, rows):
    levels = (
        rows.from_n.notna().sum(),
        rows.from_24.sum(),
        (rows.holds == Holds.TRUE.value).sum(),
    )
    degenerate = (rows.holds == Holds.DEGENERATE.value).sum()
    counts = dict(zip((*LEVELS, "degenerate", "of"), map(int, (*levels, degenerate, len(rows)))))
    return {"claim": number} | counts


def departures(options: dict) -> int:
    """How many decisions of the printed text a joint reading departs from.

    An option of one estimator (`paraboloid_normal`) is one more where it differs from that of all,
    or from the print where the reading has none of all, so that the freedom is not free.
    """
    found = sum(DEPARTURES.get(option, {}).get(value, 0) for option, value in options.items())
    for option, value in options.items():
        of_all = next((o for o in DEPARTURES if option.endswith(f"_{o}")), None)
        if of_all in options:
            found += value != options[of_all]
        elif of_all:
            found += DEPARTURES[of_all].get(value, 0)
    return found


def best(explanations, price=1) -> dict:
    """The options of the joint reading with the largest score; the first of equals; {} for none.

    `price` of a departure; the score is at a price of 1.
    """
    return next(iter(_winners(explanations, price)), {})


def search(explanations) -> dict:
    """What the search found: `options` of the best explanation, `joint`: how many readings it was
    chosen from, its `departures` and `score`, what is different in others of the same score
    (`equals`: lists of `pairs=all`), the
    whole `prices` of a departure, 0 to 5, at which it is the best, and its `neighbours`: with one
    option changed (`dihedral=signed`) the number of surfaces by claim of RANKING at the finest n;
    `always`: the largest number of surfaces by claim of RANKING on which any of them makes it true
    at every n; `fine`: FINE. {} without one."""
    options = best(explanations)
    if not options:
        return {}
    one = explanations.drop_duplicates(list(options))
    same = (one[list(options)] == pd.Series(options)).all(axis=1)
    winner = one[same].iloc[0]
    ranking = explanations[explanations.claim.isin(RANKING)]
    other = (ranking[list(options)] != pd.Series(options)).to_numpy()
    neighbours = {}
    for option, changed in zip(options, other.T):
        for value, rows in ranking[changed & (other.sum(1) == 1)].groupby(option, sort=False):
            found = rows.set_index("claim").at_finest
            neighbours[f"{option}={value}"] = {f"claim_{n}": int(found[n]) for n in RANKING}
    return {
        "options": options,
        "joint": len(one),
        "departures": int(winner.departures),
        "score": int(winner.score),
        "equals": [
            [f"{o}={v}" for o, v in other.items() if v != options[o]]
            for other in one[~same & (one.score == winner.score)][list(options)].to_dict("records")
        ],
        "prices": [price for price in range(6) if best(explanations, price) == options],
        "neighbours": neighbours,
        "always": {
            f"claim_{n}": int(most) for n, most in ranking.groupby("claim").always.max().items()
        },
        "fine": FINE,
    }


RULES = {
    "the rule": {},
    "no price": {"price": 0},
    "price of 2": {"price": 2},
    "price of 3": {"price": 3},
    "price of 4": {"price": 4},
    "at the finest n only": {"levels": LEVELS[:1]},
    "always only": {"levels": LEVELS[2:]},
    "shares of surfaces": {"shares": True},
    "claims 1 and 2": {"claims": (1, 2)},
    "claim 2": {"claims": (2,)},
    "with claim 4": {"claims": (*RANKING, 4)},
    "with claim 11": {"claims": (*RANKING, 11)},
}


def alternatives(explanations) -> pd.DataFrame:
    """alternatives.csv: the winners of other rules of scoring, a row per rule and joint reading
    with the largest score: `rule`, the options, and claims 1, 2 and 6 at the finest n.

    With shares of surfaces each count is over the surfaces that are not degenerate, times seven.
    """
    found = []
    for rule, changes in RULES.items():
        for winner in _winners(explanations, **changes):
            here = explanations[(explanations[list(winner)] == pd.Series(winner)).all(axis=1)]
            at_finest = here.set_index("claim").at_finest
            counts = {f"claim_{n}": int(at_finest[n]) for n in RANKING}
            found.append({"rule": rule} | winner | counts)
    return pd.DataFrame(found)


def _winners(explanations, price=1, levels=LEVELS, claims=RANKING, shares=False) -> list[dict]:
    """The options of the joint readings with the largest score by a rule; none without any point,
    which explains nothing."""
    options = list(explanations.columns[: explanations.columns.get_loc("claim")])
    rows = explanations[explanations.claim.isin(claims)]
    if rows.empty:
        return []
    points = rows[list(levels)].sum(axis=1)
    if shares:
        points = points / (rows.of - rows.degenerate) * len(SEVEN)
    groups = rows.assign(points=points.fillna(0)).groupby(options, sort=False)
    joint = groups.agg(points=("points", "sum"), departures=("departures", "first")).reset_index()
    score = joint.points - price * joint.departures
    # Sums of shares come out in another order.
    winners = joint[(score > score.max() - 1e-9) & joint.points.any()]
    return winners[options].to_dict("records")


def with_best(readings, explanations) -> pd.DataFrame:
    """readings.csv with the rows of the named reading `best-explanation`, if there is one."""
    options = best(explanations)
    name = ",".join(f"{option}={value}" for option, value in options.items())
    winner = readings[(readings.reading == name) & (readings.kind == "product")]
    winner = winner.assign(reading=BEST, kind="named", more=True)
    named = readings.kind == "named"
    return pd.concat([readings[named], winner, readings[~named]], ignore_index=True)


MARGINALS = ("option", "value", "claim", "mean", "most", "mean_from_24", "most_from_24")


def marginals(explanations) -> pd.DataFrame:
    """marginals.csv: per value of an option, or two of `pairs` and `dihedral`, and per claim, over
    the joint readings with that value: the mean and the largest number of surfaces on which the
    claim holds at the finest n (`mean`, `most`), and from n = 24 on (`mean_from_24`,
    `most_from_24`)."""
    options = list(explanations.columns[: explanations.columns.get_loc("claim")])
    crossed = [["pairs", "dihedral"]] if {"pairs", "dihedral"} <= set(options) else []
    found = []
    for by in [[option] for option in options] + crossed:
        groups = explanations.groupby([*by, "claim"], sort=False)
        table = groups.agg(
            mean=("at_finest", "mean"),
            most=("at_finest", "max"),
            mean_from_24=("from_24", "mean"),
            most_from_24=("from_24", "max"),
        ).reset_index()
        values = table[by].agg(" x ".join, axis=1)
        table = table.drop(columns=by)
        table.insert(0, "option", " x ".join(by))
        table.insert(1, "value", values)
        found.append(table)
    return pd.concat(found, ignore_index=True) if found else pd.DataFrame(columns=MARGINALS)
