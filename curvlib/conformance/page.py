"""The table of library functions against checks as a page: is-my-library-right.md."""

from .functions import CHECKS

MARKS = {"pass": "✓", "fail": "✗", "not applicable": "·", "not installed": " "}


def page(table) -> str:
    """Markdown of conformance.csv.

    Parameters
    ----------
    table : DataFrame
        From `cells.table`, or conformance.csv.

    Returns
    -------
    str
        The matrix, what is checked, and for each function what a user has to do, with the evidence.
    """
    table = table.fillna("")
    ran = table[table.verdict != "not installed"]
    functions, libraries = ran.function.nunique(), ran.library.nunique()
    parts = [
        "# Is my library right?",
        " ".join(
            (
                f"What {functions} functions of {libraries} libraries return, as they are",
                "installed here, checked against what a user of curvature values relies on.",
                "A ✗ is no verdict on a library: many are documented, a choice. It says what to",
                "do before values are compared with others. ✓ holds, ✗ does not,",
                f"{MARKS['not applicable']} says nothing about this function.",
            )
        ),
        _matrix(ran),
        "## What is checked",
        "\n".join(f"* **{name}**: {_first(check)}" for name, check in CHECKS.items()),
        "## What to do",
        *(_function(own) for _, own in ran.groupby("function", sort=False)),
    ]
    missing = table[table.verdict == "not installed"].drop_duplicates("function")
    if len(missing):
        rows = (f"* `{row.label}` of {row.library}" for row in missing.itertuples())
        parts += ["## Not installed", "`make peers` installs most of them.", "\n".join(rows)]
    return "\n\n".join(parts) + "\n"


def _matrix(table):
    head = ["function", *CHECKS]
    rows = [head, ["---", *[":-:"] * len(CHECKS)]]
    for _, own in table.groupby("function", sort=False):
        verdicts = dict(zip(own.check, own.verdict))
        rows.append([f"`{own.label.iloc[0]}`", *(MARKS[verdicts[check]] for check in CHECKS)])
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def _first(check):
    return " ".join(check.__doc__.split())


def _function(own):
    """The section of one function."""
    row = own.iloc[0]
    lines = [f"### `{row.label}`", f"{row.library} {row.version}, [documentation]({row.source})."]
    failed = own[own.verdict == "fail"]
    if failed.empty:
        lines.append("Nothing: all that is checked holds.")
    else:
        head = "| check | found | what to do |\n|---|---|---|\n"
        cells = ([x.check, x.evidence, x.remedy] for x in failed.itertuples())
        rows = ("| " + " | ".join(y.replace("|", "\\|") for y in x) + " |" for x in cells)
        lines.append(head + "\n".join(rows))
    said = own[own.documented != ""]
    if len(said):
        words = (f"* {x.check}: “{x.documented}”" for x in said.itertuples())
        lines.append("Its documentation says:\n\n" + "\n".join(words))
    return "\n\n".join(lines)
