"""What the verbs share: errors and exit codes, JSON, warnings, progress, tables of text."""

import csv
import json
import math
import sys
import time
import warnings
from contextlib import contextmanager

import click

PATIENCE = 1.0  # seconds before progress is shown

PATH = click.Path()  # of a file, which shells complete
json_option = click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")
threads_option = click.option(
    "--threads",
    type=click.IntRange(1),
    default=1,
    metavar="N",
    help="Number of threads. Default: 1.",
)


def names_of(*rooms):
    """A completion of names in catalogues: "estimators", "peers" or "surfaces"."""

    def complete(context, parameter, begun):
        from curvlib import catalogue

        names = [name for room in rooms for name in getattr(catalogue, room).names()]
        return [name for name in names if name.startswith(begun)]

    return complete


def put_json(document) -> None:
    """Print a JSON document; NaN and infinities become null, NumPy's numbers and arrays lists."""
    print(json.dumps(_plain(document), indent=2, allow_nan=False))


def _plain(value):
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


@contextmanager
def told_warnings():
    """Print warnings as they come, one line each on stderr; yield the list of their words."""
    said = []

    def show(message, category, filename, lineno, file=None, line=None):
        words = " ".join(str(message).split())
        if words not in said:
            said.append(words)
            print(f"warning: {words}", file=sys.stderr)

    with warnings.catch_warnings():
        from curvlib.errors import MeshWarning

        warnings.simplefilter("ignore")
        warnings.simplefilter("always", MeshWarning)
        warnings.showwarning = show
        yield said


def progress(items, words):
    """Yield the items; after a second `words(item)` and their number are shown on a terminal."""
    items, line = list(items), Line()
    for number, item in enumerate(items):
        line.show(number, len(items), f"{number}/{len(items)} {words(item)}")
        yield item
    line.clear()


@contextmanager
def progress_of_work(words):
    """Show on a terminal, after a second, how much of the vertices each pass has done."""
    from curvlib.parallel import watched

    line = Line()
    with watched(lambda done, count: line.show(done, count, f"{done / count:4.0%} {words}")):
        yield
    line.clear()


class Line:
    """A line of progress on stderr, where that is a terminal, after PATIENCE seconds."""

    def __init__(self):
        self._due = time.monotonic() + PATIENCE if sys.stderr.isatty() else math.inf
        self._shown = False

    def show(self, done, count, words):
        """Show it again, ten times a second at most."""
        now = time.monotonic()
        if now >= self._due and (self._shown or done < count):
            self._due, self._shown = now + 0.1, True
            bar = "#" * (20 * done // count)
            print(f"\r\x1b[K[{bar:<20}] {words}", end="", file=sys.stderr, flush=True)

    def clear(self):
        """Leave an empty line, if it was shown."""
        if self._shown:
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)


@contextmanager
def told_of_compiling():
    """Say once, on a terminal, that an estimator is being compiled; kept code says nothing."""
    if not sys.stderr.isatty():
        yield
        return
    from numba.core import event

    class Listener(event.Listener):
        said = False

        def on_start(self, event):
            if not self.said:
                print("compiling, once per machine and version", file=sys.stderr)
            self.said = True

        def on_end(self, event):
            """Nothing is said at the end."""

    with event.install_listener("numba:compile", Listener()):
        yield


def check_picture(path) -> None:
    """Raise InputError where a path, or None for no picture, is no .png file."""
    from curvlib.errors import InputError

    if path is not None and not path.endswith(".png"):
        raise InputError(f"{path!r}: a picture is a .png file")


def number(value) -> str:
    """Four significant digits; "-" for NaN."""
    return "-" if value != value else f"{value:.4g}"


def table_text(head, rows) -> str:
    """Rows of text in columns, the first to the left, the others to the right."""
    table = [list(map(str, row)) for row in (head, *rows)]
    widths = [max(map(len, column)) for column in zip(*table)]
    lines = []
    for first, *others in table:
        cells = [first.ljust(widths[0]), *(c.rjust(w) for c, w in zip(others, widths[1:]))]
        lines.append("  ".join(cells).rstrip())
    return "\n".join(lines)


def write_csv(path, rows: list[dict]) -> None:
    """Write CSV of rows with the same keys, whole or not at all."""
    from curvlib.files import whole_file

    with whole_file(path) as part, open(part, "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, rows[0], lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
