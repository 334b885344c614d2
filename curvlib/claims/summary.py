"""Summaries of the decided claims: a table, and the answer as text."""

import pandas as pd

from .cell import chosen
from .evidence import QUADRIC
from .sentences import CLAIMS

TOGETHER = "all"  # in place of a diagonal: all cuts of a surface
HOLDS = ("true", "undecided", "false")  # from the best to the worst


def verdicts(decided: pd.DataFrame, diagonal: str, reading: str = "default") -> pd.DataFrame:
    """Verdicts in one reading: a row per claim, a column per surface.

    Surfaces are cut along `diagonal`; a claim about all cuts is decided for them together.
    """
    here = _of_claims(decided[decided.reading == reading])
    here = here[here.diagonal.isin([diagonal, TOGETHER])]
    return here.pivot(index="claim", columns="surface", values="holds")


def summary(decided: pd.DataFrame, readings: pd.DataFrame) -> pd.DataFrame:
    """claims-summary.csv, from claims.csv and readings.csv: a row per claim.

    `section`, `sentence`, `measure`, `limit`, `holds_if`: as stated in `sentences`. `of`: the
    number of the paper's surfaces. `<reading>_true`, `_undecided`, `_false`: the surfaces with that
    verdict, cut along the first diagonal, in each named reading; `<reading>_stands`: true on most.
    `cells`, `cells_true`, `cells_undecided`: counts over surface, cut and reading. `most`: the
    largest number of surfaces with the verdict true; `most_in`: the first reading and cut with it.
    `turned_over_by`: the single changes of the default reading or of the cut that change
    `default_stands`. `undecided_on`: the surfaces that are undecided by default.
    """
    kind = readings.drop_duplicates("reading").set_index("reading").kind
    on_surfaces = decided[decided.surface != QUADRIC]
    first, surfaces = on_surfaces.diagonal.iloc[0], chosen(on_surfaces.surface)
    seven = _of_claims(on_surfaces[on_surfaces.surface.isin(surfaces)])
    rows = []
    for claim in CLAIMS.values():
        here = seven[seven.claim == claim.number]
        at_first = here[here.diagonal.isin([first, TOGETHER])]
        of_reading = _counts(at_first, "reading")
        of_cut = stands(_counts(here[here.reading == "default"], "diagonal"))
        changes = stands(of_reading)
        default, changes = changes["default"], changes[kind.index[kind == "single"]]
        turned = [*changes.index[changes != default]]
        turned += [f"diagonal={cut}" for cut in of_cut.index[of_cut != default]]
        true = (here.holds == "true").groupby([here.reading, here.diagonal], sort=False).sum()
        undecided = at_first[(at_first.reading == "default") & (at_first.holds == "undecided")]
        named = of_reading.loc[kind.index[kind == "named"]]
        named = named.assign(stands=stands(named)).stack()
        rows.append(
            {
                "claim": claim.number,
                "section": claim.section,
                "sentence": claim.sentence,
                "measure": claim.measure,
                "limit": claim.limit,
                "holds_if": claim.holds,
                "of": len(surfaces),
                **{"_".join(reading_column): x for reading_column, x in named.items()},
                "cells": len(here),
                "cells_true": int((here.holds == "true").sum()),
                "cells_undecided": int((here.holds == "undecided").sum()),
                "most": int(true.max()),
                "most_in": "{}, diagonal={}".format(*true.idxmax()),
                "turned_over_by": ", ".join(turned),
                "undecided_on": ", ".join(sorted(undecided.surface)),
            }
        )
    return pd.DataFrame(rows)


def _of_claims(cells):
    """The cells, where those of a claim about all cuts of a surface are joined into one with the
    worst verdict."""
    about_all = [claim.number for claim in CLAIMS.values() if claim.cuts == "all"]
    apart, joined = cells[~cells.claim.isin(about_all)], cells[cells.claim.isin(about_all)]
    worst = pd.Categorical(joined.holds, HOLDS, ordered=True)
    key = ["claim", "surface", "reading"]
    joined = joined.assign(holds=worst).groupby(key, sort=False).holds.max().astype(str)
    return pd.concat([apart, joined.reset_index().assign(diagonal=TOGETHER)])


def _counts(cells, column):
    """For each value of a column, the number of surfaces per verdict."""
    return pd.crosstab(cells[column], cells.holds).reindex(columns=HOLDS, fill_value=0)


def stands(counts: pd.DataFrame) -> pd.Series:
    """Whether a claim is true on more than half of the surfaces."""
    return 2 * counts["true"] > counts.sum(axis=1)


def _in_brackets(row, reading):
    """`5 of 7` surfaces where the claim is true; `5 (+1) of 7` where one more is undecided."""
    undecided = row[f"{reading}_undecided"]
    more = f" (+{undecided})" if undecided else ""
    return f"{row[f'{reading}_true']}{more} of {row['of']}"


def in_words(table: pd.DataFrame) -> str:
    """The answer for the CHANGELOG, a list item per claim, from claims-summary.csv."""
    lines = []
    for _, row in table.iterrows():
        changes = row.turned_over_by or "no single choice"
        lines.append(
            f"* Claim {row.claim} ({row.sentence[:-1]}): true on {_in_brackets(row, 'default')} "
            f"surfaces in the default reading, and in {row.cells_true} of all {row.cells} "
            f"combinations of surface, cut and reading ({row.cells_undecided} undecided); the "
            f"verdict changes with {changes}.\n"
        )
    return "".join(lines)


def _shortened(listed):
    items = listed.split(", ") if listed else ["no single choice"]
    return ", ".join(items[:2]) + (f" and {len(items) - 2} more" if len(items) > 2 else "")


def answer(table: pd.DataFrame) -> str:
    """The answer for the README, a Markdown table, from claims-summary.csv."""
    shown = pd.DataFrame({"": table.claim, "the paper says": table.sentence})
    for reading, heading in (("default", "default reading"), ("likely-run", "likely reading")):
        if f"{reading}_true" in table:
            shown[heading] = [_in_brackets(row, reading) for _, row in table.iterrows()]
    shown["verdict changes with"] = table.turned_over_by.map(_shortened)
    return shown.to_markdown(index=False, disable_numparse=True) + "\n"
