"""The answer in words, from claims-summary.csv and explanations.csv."""

import pandas as pd

from .explanations import BEST, best
from .sentences import CLAIMS


def counted(row, column) -> str:
    """`3 (+1) of 5`: true on three of the five surfaces that are not degenerate and undecided on
    one more; a claim about all surfaces together: `yes`, `no` or `undecided`."""
    if f"{column}_true" not in row or pd.isna(row[f"{column}_true"]):
        return "-"
    true, degenerate, undecided = (
        int(row[f"{column}_{holds}"]) for holds in ("true", "degenerate", "undecided")
    )
    if CLAIMS[row["claim"]].together:
        return "yes" if true else "undecided" if undecided else "no"
    more = f" (+{undecided})" if undecided else ""
    of = int(row["of"]) - degenerate
    return f"{true}{more} of {of}" if of else "degenerate"


def in_words(table: pd.DataFrame) -> str:
    """The answer for the CHANGELOG, a list item per claim, from claims-summary.csv."""
    lines = []
    for row in table.to_dict("records"):
        parts = [f"{counted(row, 'default')} on the paper's meshes"]
        parts += [f"{counted(row, 'default_refined')} refined"]
        parts += [f"{counted(row, BEST)} in the best explanation"]
        changes = row["turned_over_by"] or "no single choice"
        lines.append(
            f"* Claim {row['claim']} ({row['sentence'][:-1]}): {', '.join(parts)}; the verdict on "
            f"the paper's meshes changes with {changes}.\n"
        )
    return "".join(lines)


COLUMNS = {
    "on the paper's meshes": "default",
    "refined to n = {finest}": "default_refined",
    "on other cuts": "default_cuts",
    "best explanation": BEST,
}


def answer(table: pd.DataFrame, explanations: pd.DataFrame, finest: int) -> str:
    """The answer for the README in Markdown: sentences and a table, from claims-summary.csv and
    explanations.csv; `finest`: the largest n."""
    shown = pd.DataFrame({"": table.claim, "the paper says": table.sentence})
    rows = table.to_dict("records")
    for heading, column in COLUMNS.items():
        cells = [counted(row, column) for row in rows]
        if set(cells) != {"-"}:
            shown[heading.format(finest=finest)] = cells
    body = shown.to_markdown(index=False, disable_numparse=True)
    return f"{finding(rows, explanations)}\n\n{body}\n"


def finding(rows, explanations) -> str:
    """What was found, in sentences that follow from the tables."""
    by_number = {row["claim"]: row for row in rows}
    said = []
    if {1, 2} <= set(by_number):
        said.append(
            "**The answer.** Read as the text says, with its misprints corrected, and on meshes "
            "like the paper's, the Gauss-Bonnet scheme is "
            f"{_best_on(by_number[1], 'default')} for K, and paraboloid fitting is "
            f"{_best_on(by_number[2], 'default')} for H."
        )
    options = best(explanations)
    if options:
        row = {n: by_number[n] for n in (1, 2)}
        joint = len(explanations.drop_duplicates(list(options)))
        said.append(
            f"A search of all {joint} joint readings found the one that explains the paper best: "
            f"{in_plain_words(options)}. With it the Gauss-Bonnet scheme is "
            f"{_best_on(row[1], BEST)} for K, and paraboloid fitting is "
            f"{_best_on(row[2], BEST)} for H."
        )
    return "\n\n".join(said)


def _best_on(row, column):
    """`the best at the finest resolution on 5 of 5 surfaces and at every one on 2`."""
    true, degenerate, undecided = (
        int(row[f"{column}_{holds}"]) for holds in ("true", "degenerate", "undecided")
    )
    of, finest = int(row["of"]) - degenerate, true + undecided
    if not finest:
        return f"the best at the finest resolution on none of {of} surfaces"
    words = f"the best at the finest resolution on {finest} of {of} surfaces"
    words += f" and at every one on {true or 'none'}"
    if degenerate:
        words += f" (on the other {degenerate}, K = 0 and the best two have no error)"
    return words


WORDS = {
    ("dihedral", "as-printed"): "(3.13) literally as printed, with the angle of the next edge",
    ("dihedral", "signed"): "the signed angle at each edge in (3.13)",
    ("dihedral", "unsigned"): "the plain angle at each edge in (3.13)",
    ("area", "third"): "a third of the area in (3.12)",
    ("area", "half"): "half of the area in (3.12), as printed",
    ("area", "mixed"): "mixed Voronoi cells",
    ("pairs", "opposite"): "circles through opposite neighbours",
    ("pairs", "ring-opposite"): "circles through neighbours half a ring apart",
    ("pairs", "above-120"): "circles through any two neighbours more than 120 degrees apart",
    ("pairs", "above-90"): "circles through any two neighbours more than 90 degrees apart",
    ("pairs", "all"): "circles through all pairs of neighbours",
    ("normal", "uniform"): "plain means of the facet normals",
    ("normal", "area"): "facet normals weighted by area",
    ("normal", "exact"): "exact normals",
}


def in_plain_words(options: dict) -> str:
    """A joint reading in words."""
    order = ("dihedral", "area", "pairs", "normal")
    words = [WORDS[o, options[o]] for o in order if o in options]
    own = options.get("paraboloid_normal")
    if own not in (None, options.get("normal")):
        words.append(f"for paraboloid fitting {WORDS['normal', own]}")
    return ", ".join(words[:-1]) + " and " + words[-1] if len(words) > 1 else "".join(words)
