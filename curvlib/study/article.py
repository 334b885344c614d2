"""The article: a Typst source set with the values of this run; the same bytes each time."""

import csv
import datetime
import io
import json
from pathlib import Path

from curvlib.errors import InputError
from curvlib.files import whole_file

# The rows of long tables that the article quotes: the compiler would take seconds to select them.
EXCERPTS = {
    "errors": {"norm": ["mean"], "diagonal": ["same"]},
    "ranks": {"diagonal": ["same"], "reading": ["default"]},
    "claims": {"claim": ["1", "2"]},
}


def typeset(source, output, results, **values) -> None:
    """Write the PDF of an article to `output`.

    `source`: the main Typst file, with the files that it includes beside it. It finds the absolute
    path of the folder `results` in `sys.inputs.results` and each of `values` by its name, as JSON.
    Only the compiler's own fonts are used, so that every machine sets the same pages.

    InputError where the source is wrong, asks for a value that the results lack or makes a
    statement that they do not bear out; then nothing is written.
    """
    import typst

    inputs = {name: json.dumps(value) for name, value in values.items()}
    inputs["results"] = str(Path(results).absolute())
    try:
        pdf = typst.compile(
            str(Path(source).absolute()),
            root="/",
            sys_inputs=inputs,
            ignore_system_fonts=True,
            timestamp=datetime.datetime(1980, 1, 1, tzinfo=datetime.UTC),
        )
    except typst.TypstError as error:
        kind, _, sentence = error.message.partition(": ")
        # The article's own checks fail in one line; for a mistake in it the place is shown too.
        raised = kind in ("panicked with", "assertion failed")
        raise InputError(f"{source}: {sentence if raised else error.diagnostic}") from None
    with whole_file(output) as part:
        part.write_bytes(pdf)


def excerpts(folder, wanted: dict) -> dict:
    """Parts of the tables `<name>.csv` in a folder, as CSV text: the rows whose columns hold one of
    the values wanted, name -> column -> values."""
    return {name: _excerpt(Path(folder, f"{name}.csv"), where) for name, where in wanted.items()}


def _excerpt(path, where):
    found = io.StringIO()
    with path.open(newline="", encoding="utf-8") as file:
        rows, writer = csv.reader(file), csv.writer(found, lineterminator="\n")
        header = next(rows)
        writer.writerow(header)
        for column, values in where.items():
            at = header.index(column)
            rows = filter(lambda row, at=at, values=values: row[at] in values, rows)
        writer.writerows(rows)
    return found.getvalue()


def caption(path) -> str:
    """A caption file's text on one line."""
    return " ".join(Path(path).read_text(encoding="utf-8").split())
