"""The benchmark in words: which estimator for which mesh, at what cost, by what margin."""

import numpy as np

from .advice import DEFAULT, QUANTITIES, SITUATIONS
from .ranking import COMPLETE

SAID = {"K": "Gaussian curvature K", "H": "mean curvature H", "d1": "directions"}
FIRST = 5  # of a ranking that are shown
# Ranks as far apart as this over statistics and surfaces are told.
APART = 3


def recommendation(advice) -> str:
    """recommendation.md: the advice as a table per quantity, and in sentences.

    Parameters
    ----------
    advice : DataFrame
        advice.csv.

    Returns
    -------
    str
        Markdown.
    """
    parts = [
        "# Recommendation",
        "The best of our estimators in each situation, by the geometric mean over meshes of the "
        "mean error over the least on that mesh. *Margin*: how many times that of the second. "
        f"*{DEFAULT}*: the default's error over the best. Costs are processor time of one thread, "
        f"in microseconds a vertex. Estimators without values at {COMPLETE:.0%} of the vertices of "
        "every mesh of the situation are left out. Errors below a millionth of the largest "
        "curvature count as equal.",
    ]
    for quantity in QUANTITIES:
        own = advice[advice.quantity == quantity]
        if not len(own):
            continue
        rows = [
            [
                _label(row.situation),
                f"`{row.best}`",
                _number(row.best_microseconds),
                f"{_number(row.margin)} (`{row.second}`)" if row.second else "",
                _ranks(row),
                f"`{row.cheap}`, {_number(row.cheap_microseconds)}"
                if row.cheap != row.best
                else "the same",
                _number(row.default_over),
            ]
            for row in own.fillna({"second": ""}).itertuples()
        ]
        head = ["mesh", "best", "µs", "margin over the second", "rank", "cheapest within 2"]
        head += [DEFAULT]
        parts += [f"## For {SAID[quantity]}", _markdown(head, rows)]
    parts += ["## In words", *_words(advice)]
    return "\n\n".join(parts) + "\n"


def _words(advice):
    over = advice.default_over.dropna()
    if len(over):
        first = int((over <= 1).sum())
        worst = advice.loc[over.idxmax()]
        yield (
            f"`{DEFAULT}`, the default, is the best in {first} of {len(over)} cases, within twice "
            f"the best error in {int((over <= 2).sum())}, and at worst {_number(over.max())} times "
            f"(`{worst.best}` for {SAID[worst.quantity]}, {_label(worst.situation)})."
        )
    for situation in SITUATIONS:
        own = advice[advice.situation == situation.name].set_index("quantity")
        if not len(own):
            continue
        said = [_sentence(quantity, row) for quantity, row in own.iterrows()]
        yield f"**{situation.label}** ({situation.words}): {'; '.join(said)}."


def _sentence(quantity, row):
    words = f"for {SAID[quantity]} `{row.best}` ({_number(row.best_microseconds)} µs)"
    if np.isfinite(row.margin):
        if row.margin < 1.1:
            words += f", on a par with `{row.second}`"
        else:
            words += f", {_number(row.margin)} times better than `{row.second}`"
    if row.rank_high - row.rank_low >= APART:
        words += f", though by other statistics its rank falls to {row.rank_high:.0f}"
    if row.cheap != row.best:
        words += f"; `{row.cheap}` costs {_number(row.cheap_microseconds)} µs and errs "
        words += f"{_number(row.cheap_over)} times as much"
    return words


def which(advice, table, cost, methods, plan) -> str:
    """which-estimator.md: the page for users, with the ranking of every situation.

    Parameters
    ----------
    advice, table, cost, methods : DataFrame
        advice.csv, situations.csv, cost.csv and methods.csv.
    plan : curvlib.benchmark.plan.Plan

    Returns
    -------
    str
        Markdown.
    """
    price = cost.set_index("estimator").microseconds
    there = methods[methods.note != "not installed"]
    peers = there[there.kind == "peer"]
    absent = methods[methods.note == "not installed"].estimator
    versions = [f"`{r.estimator}` ({r.library} {r.version})" for r in peers.itertuples()]
    parts = [
        "# Which estimator should I use?",
        f"Unless you know better, `{DEFAULT}`: it looks at the mesh and chooses. The tables show "
        "where another one is more accurate or cheaper. They are made by `snakemake benchmark` "
        f"from {len(plan.families)} families of meshes with exact curvature and "
        f"{len(plan.noise['kinds'])} kinds of noise at {len(plan.noise['levels'])} levels.",
        f"Compared: {(there.kind == 'ours').sum()} estimators of ours, with options where they "
        "matter"
        + (f"; of other libraries {', '.join(versions)}" if versions else "")
        + (f". Not installed: {', '.join(f'`{x}`' for x in absent)}" if len(absent) else "")
        + ".",
        recommendation(advice).split("\n", 2)[2].strip(),
        "## The rankings",
        f"The first {FIRST}, and `{DEFAULT}`; *over the best*: the geometric mean over the meshes "
        "of the mean error over the least on that mesh; *wins*: on which part of the meshes the "
        "error is within 10 % of the least; *ranks*: the range over four norms (mean, median, 95 % "
        "quantile, largest), the wins, and leaving out each surface.",
    ]
    for situation in SITUATIONS:
        for quantity in QUANTITIES:
            own = table[(table.situation == situation.name) & (table.quantity == quantity)]
            own = own[own["rank"].notna()].reset_index(drop=True)
            if not len(own):
                continue
            shown = own[(own.index < FIRST) | (own.estimator == DEFAULT)]
            rows = [
                [
                    f"{row.rank:.0f}",
                    f"`{row.estimator}`",
                    _number(row.over_best),
                    f"{row.wins:.0%}",
                    f"{row.rank_low:.0f} to {row.rank_high:.0f}",
                    _number(price.get(row.estimator, np.nan)),
                ]
                for row in shown.itertuples()
            ]
            head = ["rank", "estimator", "over the best", "wins", "ranks", "µs a vertex"]
            of = f"{len(own)} ranked, {own.of[0]} meshes"
            title = f"### {situation.label}: {SAID[quantity]} ({of})"
            parts += [title, _markdown(head, rows)]
    return "\n\n".join(parts) + "\n"


def _label(name):
    return next(s.label for s in SITUATIONS if s.name == name)


def _ranks(row):
    return "1" if row.rank_high == 1 else f"{row.rank_low:.0f} to {row.rank_high:.0f}"


def _number(x):
    if not np.isfinite(x):
        return "-"
    return f"{x:.2g}" if x < 99.5 else f"{x:.0f}" if x < 1e4 else f"{x:.1e}"


def _markdown(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
