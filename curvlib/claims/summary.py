"""The decided claims, summed up: tables and the answers in words."""

import pandas as pd

from .sentences import CLAIMS, chosen

TOGETHER = "all"  # in place of a diagonal


def verdicts(decided: pd.DataFrame, diagonal: str, reading: str = "default") -> pd.DataFrame:
    """Claims against surfaces: whether each holds there, in one reading, as cut by `diagonal` or,
    where the claim is about them, in all cuts together."""
    here = _of_claims(decided[decided.reading == reading])
    here = here[here.diagonal.isin([diagonal, TOGETHER])]
    return here.pivot(index="claim", columns="surface", values="holds")


def summary(decided: pd.DataFrame, named, singles, diagonals) -> pd.DataFrame:
    """claims-summary.csv: each claim in words, how it fares on the paper's surfaces in the `named`
    readings on the first diagonal, which of the `singles` readings or diagonals turns it over,
    and on how many surfaces at most it is true in any reading and cut, with the first such."""
    on_surfaces = decided[decided.diagonal.isin(diagonals)]
    surfaces = chosen(on_surfaces.surface)
    seven = _of_claims(on_surfaces[on_surfaces.surface.isin(surfaces)])
    rows = []
    for claim in CLAIMS:
        here = seven[seven.claim == claim.number]
        at_first = here[here.diagonal.isin([diagonals[0], TOGETHER])]
        readings = {r: outcome(x) for r, x in at_first.groupby("reading")}
        cuts = {d: outcome(x) for d, x in here[here.reading == "default"].groupby("diagonal")}
        default = readings["default"]
        turned = [r for r in singles if stands(readings[r]) != stands(default)]
        turned += [f"diagonal={d}" for d, o in cuts.items() if stands(o) != stands(default)]
        every = here.groupby(["reading", "diagonal"], sort=False).holds
        most = every.agg(lambda holds: (holds == "true").sum())
        reading, diagonal = most.idxmax()
        open_on = at_first[(at_first.reading == "default") & (at_first.holds == "undecided")]
        rows.append(
            {
                "claim": claim.number,
                "section": claim.section,
                "sentence": claim.sentence,
                "measure": claim.measure,
                "limit": claim.limit,
                "holds_if": claim.holds,
                **{reading: readings[reading] for reading in named},
                "cells": len(here),
                "true": int((here.holds == "true").sum()),
                "undecided": int((here.holds == "undecided").sum()),
                "most": int(most.max()),
                "most_in": f"{reading}, diagonal={diagonal}",
                "turned_over_by": ", ".join(turned),
                "undecided_on": ", ".join(sorted(open_on.surface)),
            }
        )
    return pd.DataFrame(rows)


def _of_claims(cells):
    """The cells that count: those of a claim about all cuts of a surface are put together, false
    if it is false in one of them, else undecided if it is that in one."""
    about_all = [claim.number for claim in CLAIMS if claim.cuts == "all"]
    apart, joined = cells[~cells.claim.isin(about_all)], cells[cells.claim.isin(about_all)]
    worst = pd.Categorical(joined.holds, ["true", "undecided", "false"], ordered=True)
    key = ["claim", "surface", "reading"]
    joined = joined.assign(holds=worst).groupby(key, sort=False).holds.max().astype(str)
    return pd.concat([apart, joined.reset_index().assign(diagonal=TOGETHER)])


def outcome(cells) -> str:
    """`5 of 7`: on how many surfaces it is true; `5 (+1) of 7` where one more is undecided."""
    count = cells.holds.value_counts()
    more = f" (+{count['undecided']})" if "undecided" in count else ""
    return f"{count.get('true', 0)}{more} of {len(cells)}"


def stands(outcome: str) -> bool:
    """Whether a claim is true on more than half of the surfaces."""
    return 2 * int(outcome.split()[0]) > int(outcome.split()[-1])


def in_words(table: pd.DataFrame) -> str:
    """The same for the CHANGELOG: a line of a list per claim."""
    lines = []
    for claim in table.itertuples():
        turned = claim.turned_over_by or "no single choice"
        lines.append(
            f"* Claim {claim.claim} ({claim.sentence[:-1]}): true on {claim.default} surfaces in "
            f"the default reading, and in {claim.true} of all {claim.cells} combinations of "
            f"surface, cut and reading ({claim.undecided} undecided); turned over by {turned}.\n"
        )
    return "".join(lines)


def _shortened(listed):
    items = listed.split(", ") if listed else ["no single choice"]
    return ", ".join(items[:2]) + (f" and {len(items) - 2} more" if len(items) > 2 else "")


def answer(table: pd.DataFrame) -> str:
    """The README's answer, in Markdown, from claims-summary.csv."""
    columns = {"claim": "", "sentence": "the paper says", "default": "true on"}
    columns |= {"likely-run": "as likely run", "turned_over_by": "turned over by"}
    shown = table[[c for c in columns if c in table]].rename(columns=columns)
    shown["turned over by"] = shown["turned over by"].map(_shortened)
    return shown.to_markdown(index=False, disable_numparse=True) + "\n"
