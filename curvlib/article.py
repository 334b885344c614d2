"""The article: a Typst source set with what this run found; the same bytes each time."""

import datetime
import json
from pathlib import Path

from .errors import InputError


def typeset(source, output, results, **values) -> None:
    """Write the PDF of an article to `output`.

    `source`: its main Typst file; what that includes lies beside it. It finds the absolute path
    of the folder `results` in `sys.inputs.results` and each of `values` by its name, as JSON.
    Fonts are those that come with the compiler, so that every machine sets the same pages.

    Raises InputError with the compiler's message where the source is wrong or asks for a value
    that the results do not have; then nothing is written.
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
        raise InputError(f"{source}: {error.diagnostic or error.message}") from None
    Path(output).write_bytes(pdf)


def caption(path) -> str:
    """A caption file's text on one line."""
    return " ".join(Path(path).read_text().split())
