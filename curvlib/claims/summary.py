"""Summaries of the decided claims: verdicts by surface, counts, agreement of rankings."""

import pandas as pd

from .cell import FAVOURITES, NINE, SEVEN, Holds, chosen, kendall_tau
from .evidence import PAPER, QUADRIC, REFINED, TOGETHER, Evidence
from .explanations import RANKING
from .rankings import always_best
from .sentences import CLAIMS

HOLDS = [holds.value for holds in reversed(Holds)]  # from the best to the worst


def verdicts(decided: pd.DataFrame, surfaces) -> pd.DataFrame:
    """The rows of claims.csv on the paper's meshes, of these surfaces and of all together."""
    return decided[(decided.meshes == PAPER) & decided.surface.isin([*surfaces, TOGETHER])]


def summary(decided: pd.DataFrame, readings: pd.DataFrame) -> pd.DataFrame:
    """claims-summary.csv, from claims.csv and readings.csv: a row per claim.

    `section`, `sentence`, `measure`, `limit`, `holds_if`, `by_n`: as registered. `of`: the
    number of the paper's surfaces, 1 for a claim about them together. `<reading>_true`,
    `_degenerate`, `_undecided`, `_false`: the surfaces with that verdict on the paper's meshes, in
    each named reading; `<reading>_at_finest`, `<reading>_from_24`: those on which it holds at the
    finest n and at every n >= 24; `<reading>_stands`: true on most of those that are not
    degenerate. `<reading>_refined_true` etc.: the same up to the finest meshes of the paper's cut;
    `default_cuts_true` etc.: the worst over the other cuts. `turned_over_by`: the single changes of
    the default reading that change `default_stands`; `turned_over_on`: the cuts that do.
    """
    kind = readings.drop_duplicates("reading").set_index("reading").kind
    on_surfaces = decided[decided.surface != QUADRIC]
    (cut,) = on_surfaces.diagonal[on_surfaces.meshes == PAPER].unique()
    seven = [*chosen(on_surfaces.surface[on_surfaces.surface != TOGETHER]), TOGETHER]
    seven = on_surfaces[on_surfaces.surface.isin(seven)]
    paper, refined = seven[seven.meshes == PAPER], seven[seven.meshes == REFINED]
    others = refined[refined.diagonal != cut]
    refined = refined[refined.diagonal == cut]
    named, single = (kind.index[kind == which] for which in ("named", "single"))
    rows = []
    for claim in CLAIMS.values():
        here = paper[paper.claim == claim.number]
        if here.empty:
            continue
        of_reading = _counts(here, "reading")
        row = {
            "claim": claim.number,
            "section": claim.section,
            "sentence": claim.sentence,
            "measure": claim.measure,
            "limit": claim.limit,
            "holds_if": claim.holds,
            "by_n": claim.by_n,
            "of": here[here.reading == "default"].surface.nunique(),
        }
        for name in named:
            row |= {f"{name}_{holds}": n for holds, n in of_reading.loc[name].items()}
            row |= _by_n(here, name, name)
            row[f"{name}_stands"] = stands(of_reading).loc[name]
        finer = refined[refined.claim == claim.number]
        counts = _counts(finer, "reading")
        for name in counts.index.intersection(named):
            row |= {f"{name}_refined_{holds}": n for holds, n in counts.loc[name].items()}
            row |= _by_n(finer, name, f"{name}_refined")
        elsewhere = others[(others.claim == claim.number) & (others.reading == "default")]
        if len(elsewhere):
            worst = elsewhere.groupby("surface").holds.agg(
                lambda holds: max(holds, key=HOLDS.index)
            )
            counts = worst.value_counts().reindex(HOLDS, fill_value=0)
            row |= {f"default_cuts_{holds}": n for holds, n in counts.items()}
        here = stands(of_reading)
        there = stands(_counts(elsewhere, "diagonal"))
        changes = here[single]
        row["turned_over_by"] = ", ".join(changes.index[changes != here["default"]])
        row["turned_over_on"] = ", ".join(there.index[there != here["default"]])
        rows.append(row)
    # Counts stay integers where a claim lacks some.
    return pd.DataFrame(rows).convert_dtypes()


def _by_n(cells, reading, column):
    """On how many surfaces a claim holds at the finest n, and from n = 24 on."""
    cells = cells[cells.reading == reading]
    counts = cells.from_n.notna().sum(), cells.from_24.sum()
    return dict(zip((f"{column}_at_finest", f"{column}_from_24"), map(int, counts)))


def _counts(cells, column):
    """For each value of a column, the number of surfaces per verdict."""
    return pd.crosstab(cells[column], cells.holds).reindex(columns=HOLDS, fill_value=0)


def stands(counts: pd.DataFrame) -> pd.Series:
    """Whether a claim is true on more than half of the surfaces that are not degenerate."""
    return 2 * counts["true"] > counts.sum(axis=1) - counts["degenerate"]


def on_other_cuts(decided) -> dict:
    """What the refined rows of claims.csv say of the ranking on other cuts.

    `at_finest`: cut -> claim of RANKING (`claim_2`) -> on how many of the paper's surfaces it holds
    by default at the finest n; `whole_ranking`: (reading, cut, surface) where all three are true at
    every n.
    """
    cut = decided.diagonal[decided.meshes == PAPER].iloc[0]
    others = decided[(decided.meshes == REFINED) & (decided.diagonal != cut)]
    others = others[others.claim.isin(RANKING) & others.surface.isin(SEVEN)]
    default = others[others.reading == "default"]
    at_finest = default.from_n.notna().groupby([default.diagonal, default.claim], sort=False).sum()
    found = {}
    for (diagonal, claim), count in at_finest.items():
        found.setdefault(diagonal, {})[f"claim_{claim}"] = int(count)
    true = (others.holds == "true").groupby([others.reading, others.diagonal, others.surface])
    whole = true.sum()
    return {
        "at_finest": found,
        "whole_ranking": [list(place) for place in whole.index[whole == len(RANKING)]],
    }


def agreement(readings, variants) -> pd.DataFrame:
    """agreement.csv: Kendall's tau between the rankings on two surfaces, at the finest of the
    paper's meshes.

    Columns: reading (the named ones), quantity, surface, other, `tau`; empty where a ranking is
    degenerate or an error is missing.
    """
    surfaces = chosen(variants.surface)
    rows = []
    for name, cells in _named(readings, variants, surfaces):
        for quantity in FAVOURITES:
            ranked = {surface: cell.ranking(quantity) for surface, cell in cells.items()}
            rows += [
                {
                    "reading": name,
                    "quantity": quantity,
                    "surface": surface,
                    "other": other,
                    "tau": kendall_tau(ranked[surface], ranked[other])
                    if ranked[surface] and ranked[other]
                    else None,
                }
                for surface in surfaces
                for other in surfaces
            ]
    return pd.DataFrame(rows, columns=["reading", "quantity", "surface", "other", "tau"])


def decided_by_ties(readings, variants, ties=(0, 0.02, 0.05, 0.1)) -> list[tuple]:
    """The verdicts on claims 1 and 2 on the paper's meshes that depend on the tolerance of a tie:
    (reading, quantity, surface) of the named readings and the paper's surfaces."""
    return [
        (name, quantity, surface)
        for name, cells in _named(readings, variants, chosen(variants.surface))
        for surface, cell in cells.items()
        for quantity in FAVOURITES
        if len({always_best(cell, quantity, tie).holds for tie in ties}) > 1
    ]


def _named(readings, variants, surfaces):
    """(reading, surface -> Cell on the paper's meshes) for the named readings of all nine."""
    evidence = Evidence(variants[variants.paper & variants.surface.isin(surfaces)])
    for name, reading in readings[readings.kind == "named"].groupby("reading", sort=False):
        if not set(NINE) - set(reading.estimator):
            yield name, {cell.surface: cell for _, cell in evidence.cells(reading)}
