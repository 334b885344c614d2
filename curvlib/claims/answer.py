"""The answer in words, from claims-summary.csv and what the search found."""

import textwrap

import pandas as pd

from .cell import NINE, SEVEN
from .explanations import BEST
from .sentences import CLAIMS


def counted(row, column) -> str:
    """On how many of the surfaces that are not degenerate a claim holds.

    `0 / 3 / 3 of 5` of a claim about the ranking: always, at every n >= 24, at the finest n;
    `5 (+1) of 7` of another: true, and undecided on one more; `yes`, `no` or `undecided` of a claim
    about all surfaces together.
    """
    if pd.isna(row.get(f"{column}_true")):
        return "-"
    true, undecided = (int(row[f"{column}_{holds}"]) for holds in ("true", "undecided"))
    claim, of = CLAIMS[row["claim"]], _of(row, column)
    if claim.together:
        return "yes" if true else "undecided" if undecided else "no"
    if not of:
        return "degenerate"
    if claim.by_n and f"{column}_at_finest" in row:
        return f"{true} / {row[f'{column}_from_24']} / {row[f'{column}_at_finest']} of {of}"
    return f"{true}{f' (+{undecided})' if undecided else ''} of {of}"


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
    "on every other cut": "default_cuts",
    "best explanation": BEST,
}


def answer(table, found: dict, finest: int) -> str:
    """The answer for the README in Markdown, its sentences and a table, from claims-summary.csv and
    `findings`; `finest`: the largest n."""
    shown = pd.DataFrame({"": table.claim, "the paper says": table.sentence})
    rows = table.to_dict("records")
    for heading, column in COLUMNS.items():
        cells = [counted(row, column) for row in rows]
        if set(cells) != {"-"}:
            shown[heading.format(finest=finest)] = cells
    body = shown.to_markdown(index=False, disable_numparse=True)
    said = [found[name] for name in ("ranking", "explanation", "irregular") if found[name]]
    items = [textwrap.fill(f"* {words}", 100, subsequent_indent="  ") for words in said]
    parts = [headline(rows) if said else "", "\n".join(items), body]
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
    of, finest = _of(row, column), int(row[f"{column}_at_finest"])
    if not of:
        return "nothing to rank"
    if int(row[f"{column}_true"]) == of:
        return "yes"
    return "in part, at fine resolutions" if 2 * finest > of else "no"


def findings(table, searched: dict, convergence, elsewhere: dict) -> dict:
    """What was found, in sentences that follow from the tables: `ranking`, `explanation`,
    `irregular`; empty where the study does not say. `searched`: from
    `explanations.search`; `elsewhere`: from `summary.on_other_cuts`."""
    rows = {row["claim"]: row for row in table.to_dict("records")}
    found = dict.fromkeys(("ranking", "explanation", "irregular"), "")
    if not {1, 2} <= set(rows) or set(NINE) - set(convergence.estimator):
        return found
    found["ranking"] = (
        "With the misprints of the text corrected, and on meshes like the paper's, the "
        f"Gauss-Bonnet scheme is the best of the nine for K {_best_on(rows[1], 'default')}; "
        f"paraboloid fitting is the best for H {_best_on(rows[2], 'default')}."
    )
    cuts = {cut: counts["claim_2"] for cut, counts in elsewhere["at_finest"].items()}
    if cuts and max(cuts.values()) > rows[2]["default_at_finest"]:
        cut = max(cuts, key=cuts.get)
        found["ranking"] += f" On the same grids cut otherwise it is on up to {cuts[cut]} ({cut})."
    if searched:
        options = searched["options"]
        also = "".join(f" ({', '.join(other)} scores the same)" for other in searched["equals"][:1])
        found["explanation"] = (
            f"A search of all {searched['joint']} joint readings of the text found what explains "
            f"the paper best: {in_plain_words(options)}{also}. With it the Gauss-Bonnet scheme is "
            f"the best for K {_best_on(rows[1], BEST)}, and paraboloid fitting for H "
            f"{_best_on(rows[2], BEST)}." + _needed(searched, rows[2])
        )
    found["irregular"] = irregular(convergence)
    return found


def _needed(searched, row):
    """Which choices of the best explanation it cannot do without for claim 2."""
    lost = {
        option: searched["neighbours"][f"{option}={value}"]["claim_2"]
        for option, value in (("dihedral", "signed"), ("pairs", "opposite"))
        if f"{option}={value}" in searched["neighbours"]
    }
    printed = searched["options"].get("dihedral") == "as-printed"
    if not printed or len(lost) < 2 or 2 * max(lost.values()) > row[f"{BEST}_at_finest"]:
        return ""
    return (
        " So the advice on H would come not from the method but from a misprint that was also run, "
        "together with loose circle pairs; with the signed angle paraboloid fitting is the best on "
        f"{lost['dihedral'] or 'none'}, with opposite pairs on {lost['pairs'] or 'none'}. This is "
        "an explanation that fits, not a proof."
    )


def _best_on(row, column):
    """`on 5 of 7 surfaces at the finest resolution, and on none at every one`."""
    of, degenerate = _of(row, column), int(row[f"{column}_degenerate"])
    finest, true = int(row[f"{column}_at_finest"]), int(row[f"{column}_true"])
    if not finest:
        words = f"on none of {of} surfaces, not even at the finest resolution"
    elif true == finest:
        words = f"at every resolution on {true} of {of} surfaces"
    else:
        words = f"on {finest} of {of} surfaces at the finest resolution, and on {true or 'none'} "
        words += "at every one"
    return words + (f" ({degenerate} more have nothing to rank)" if degenerate else "")


def _of(row, column):
    """The number of surfaces that are not degenerate."""
    return int(row["of"]) - int(row[f"{column}_degenerate"])


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
