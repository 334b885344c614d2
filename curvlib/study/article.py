"""The article: a Typst source compiled with the values of this run; the same bytes each time."""

import csv
import datetime
import io
import json
from pathlib import Path

from curvlib.errors import InputError
from curvlib.files import whole_file

# Rows of long tables that the article quotes: Typst would take seconds to select them.
QUOTED = ["default", "as-printed", "best-explanation", "exact-normals"]
EXCERPTS = {
    "errors": {"norm": ["mean", "median"], "diagonal": ["same"], "reading": QUOTED},
    "ranks": {"diagonal": ["same"], "reading": QUOTED},
    "claims": {"diagonal": ["same"], "reading": QUOTED},
    "noise": {"surface": ["sphere", "teapot_body"], "quantity": ["K", "H"]},
}


def typeset(source, output, results, **values) -> None:
    """Write the PDF of an article to `output`.

    `source`: the main Typst file, with the files that it includes beside it. It finds the absolute
    path of the folder `results` in `sys.inputs.results` and each of `values` by its name, as JSON.
    Only the compiler's own fonts are used, so that every machine sets the same pages.

    Raises InputError, and writes nothing, if the source has an error, asks for a value that the
    results lack, or makes a statement that contradicts them.
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
        # A failed check of the article is one line; an error in its source needs the place.
        raised = kind in ("panicked with", "assertion failed")
        raise InputError(f"{source}: {sentence if raised else error.diagnostic}") from None
    with whole_file(output) as part:
        part.write_bytes(pdf)


def excerpts(folder, wanted: dict) -> dict:
    """Excerpts of the tables `<name>.csv` in a folder, as CSV text.

    `wanted`: name -> column -> values; rows with one of these values in each column are kept.
    """
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
