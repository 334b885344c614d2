"""The article: a Typst source set with what this run found; the same bytes each time."""

import datetime
import json
from pathlib import Path

from curvlib.errors import InputError


def typeset(source, output, results, **values) -> None:
    """Write the PDF of an article to `output`.

    `source`: its main Typst file; what that includes lies beside it. It finds the absolute path
    of the folder `results` in `sys.inputs.results` and each of `values` by its name, as JSON.
    Fonts are those that come with the compiler, so that every machine sets the same pages.

    Raises InputError where the source is wrong, asks for a value that the results do not have or
    says what they do not bear out; then nothing is written.
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
        # What the article itself says in one line; of a mistake in it the compiler shows where.
        raised = kind in ("panicked with", "assertion failed")
        raise InputError(f"{source}: {sentence if raised else error.diagnostic}") from None
    Path(output).write_bytes(pdf)


def excerpts(folder, wanted: dict) -> dict:
    """Of tables `<name>.csv` in a folder the header and the lines whose columns have one of the
    values wanted, name -> column -> values: the compiler would take seconds to find them."""
    found = {}
    for name, where in wanted.items():
        with Path(folder, f"{name}.csv").open(newline="") as file:
            header, *lines = file
        columns = header.rstrip().split(",")
        for column, values in where.items():
            at = columns.index(column)
            # What is quoted has commas in later columns alone.
            lines = [line for line in lines if line.rstrip().split(",", at + 1)[at] in values]
        found[name] = "".join((header, *lines))
    return found


def caption(path) -> str:
    """A caption file's text on one line."""
    return " ".join(Path(path).read_text().split())
