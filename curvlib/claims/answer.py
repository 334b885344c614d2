"""The answer in words, from claims-summary.csv and explanations.csv."""

import textwrap

import pandas as pd

from .cell import NINE, SEVEN
from .explanations import BEST, search
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


def answer(table, explanations, convergence, finest: int) -> str:
    """The answer for the README in Markdown, its sentences and a table: from claims-summary.csv,
    explanations.csv and convergence.csv; `finest`: the largest n."""
    shown = pd.DataFrame({"": table.claim, "the paper says": table.sentence})
    rows = table.to_dict("records")
    for heading, column in COLUMNS.items():
        cells = [counted(row, column) for row in rows]
        if set(cells) != {"-"}:
            shown[heading.format(finest=finest)] = cells
    body = shown.to_markdown(index=False, disable_numparse=True)
    found = [said for said in findings(table, explanations, convergence).values() if said]
    items = [textwrap.fill(f"* {said}", 100, subsequent_indent="  ") for said in found]
    parts = [headline(rows), "\n".join(items), body]
    return "\n\n".join(part for part in parts if part) + "\n"


def headline(rows) -> str:
    """The answer in one sentence: whether claims 1 and 2 hold, by default and as explained best."""
    by_number = {row["claim"]: row for row in rows}
    if not {1, 2} <= set(by_number):
        return ""
    words = "**The answer**: for K {}, for H {}.".format(
        *(_in_short(by_number[n], "default") for n in (1, 2))
    )
    if f"{BEST}_true" in by_number[1]:
        explained = " In the reading that explains the paper best: for K {}, for H {}."
        words += explained.format(*(_in_short(by_number[n], BEST) for n in (1, 2)))
    return textwrap.fill(words, 100)


def _in_short(row, column):
    of = int(row["of"]) - int(row[f"{column}_degenerate"])
    if not of:
        return "nothing to rank"
    if int(row[f"{column}_true"]) == of:
        return "yes"
    return "in part" if 2 * _at_finest(row, column) > of else "no"


def findings(table, explanations, convergence) -> dict:
    """What was found, in sentences that follow from the tables: `ranking`, `explanation`,
    `irregular`; empty where the study does not say."""
    rows = {row["claim"]: row for row in table.to_dict("records")}
    found = dict.fromkeys(("ranking", "explanation", "irregular"), "")
    if not {1, 2} <= set(rows):
        return found
    found["ranking"] = (
        "With the misprints of the text corrected, and on meshes like the paper's, for K the "
        f"Gauss-Bonnet scheme is {_best_on(rows[1], 'default')}; for H paraboloid fitting is "
        f"{_best_on(rows[2], 'default')}."
    )
    searched = search(explanations)
    if searched:
        options = searched["options"]
        found["explanation"] = (
            f"A search of all {searched['joint']} joint readings of the text found the one that "
            f"explains the paper best: {in_plain_words(options)}. With it, for K the "
            f"Gauss-Bonnet scheme is {_best_on(rows[1], BEST)}; for H paraboloid fitting is "
            f"{_best_on(rows[2], BEST)}."
        )
        gained = _at_finest(rows[2], BEST) > _at_finest(rows[2], "default")
        if options.get("dihedral") == "as-printed" and gained:
            found["explanation"] += (
                " So not the method, but a misprint that was also in the program would give the "
                "paper's advice on H: an explanation that fits, not a proof."
            )
    found["irregular"] = irregular(convergence)
    return found


def irregular(convergence) -> str:
    """Which of the nine converge on irregular meshes for K and H, on all of the paper's surfaces,
    for every seed; empty where the study does not have such meshes, or not all of the nine."""
    kind = convergence.diagonal.str.replace(r"-\d+$", "", regex=True)
    here = convergence[convergence.surface.isin(SEVEN) & convergence.estimator.isin(NINE)]
    wanted = {"jittered", "random", "alternate"}, {"default", "exact-normals"}
    complete = here.estimator.nunique() == 9 and here.surface.nunique() == 7
    if not (complete and wanted[0] <= set(kind) and wanted[1] <= set(here.reading)):
        return ""
    good = here.verdict.isin(["converges", "exact"])
    every = good.groupby([kind, here.reading, here.estimator]).all()

    def named(cut, reading):
        every_there = every[cut, reading]
        names = [NAMES[name] for name in every_there.index[every_there]]
        return " and ".join(names) + " alone" if names else "none of the nine"

    return (
        f"On grids with jittered points, {named('jittered', 'default')} converges on all seven "
        f"surfaces for K and H with estimated normals, {named('jittered', 'exact-normals')} with "
        f"exact ones. With these, {named('random', 'exact-normals')} does on random diagonals and "
        f"{named('alternate', 'exact-normals')} on alternate ones."
    )


def _at_finest(row, column):
    return int(row[f"{column}_true"]) + int(row[f"{column}_undecided"])


def _best_on(row, column):
    """`the best of the nine at the finest resolution on 5 of 7 surfaces, and always on none`."""
    true, degenerate = int(row[f"{column}_true"]), int(row[f"{column}_degenerate"])
    of, finest = int(row["of"]) - degenerate, _at_finest(row, column)
    if not finest:
        words = f"the best of the nine on none of {of} surfaces, not even at the finest resolution"
    elif true == finest:
        words = f"always the best of the nine on {true} of {of} surfaces"
    else:
        words = f"the best of the nine at the finest resolution on {finest} of {of} surfaces, and "
        words += f"always on {true or 'none'}"
    return words + (f" (on {degenerate} more the two best have no error)" if degenerate else "")


NAMES = {
    "circular": "circular fitting",
    "gauss_bonnet": "the Gauss-Bonnet scheme",
    "paraboloid": "paraboloid fitting",
    "taubin": "Taubin's method",
    "taubin_a": "Taubin A",
    "taubin_b": "Taubin B",
    "watanabe": "Watanabe's method",
    "watanabe_a": "Watanabe A",
    "watanabe_b": "Watanabe B",
}
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
