"""Captions of figures and tables: files of a title, underlined, and plain sentences."""

from collections import namedtuple
from pathlib import Path

from curvlib.comparison.quantities import QUANTITIES
from curvlib.errors import InputError

Caption = namedtuple("Caption", "title text")


def read(path) -> Caption:
    """The title and the text of a caption file, each on one line."""
    title, underline, *rest = Path(path).read_text(encoding="utf-8").splitlines()
    if not title or underline != "=" * len(title):
        raise InputError(f"{path}: line 2 has to underline the title with {len(title)} times '='")
    return Caption(title, " ".join(" ".join(rest).split()))


def found(name: str, folder) -> Path:
    """The caption file of a figure: its own or that of its kind, `error-K` for `error-K-cone`.

    Raises InputError where there is neither.
    """
    parts = name.split("-")
    kinds = ("-".join(parts[:n]) for n in range(len(parts), 0, -1))
    files = [Path(folder, f"{kind}.rst") for kind in kinds]
    for file in files:
        if file.exists():
            return file
    raise InputError(f"figure {name!r} has no caption: write {files[0]}")


def labels(name: str, file, surfaces: dict) -> dict[str, str]:
    """What a figure shows, in words: `what`, and where its name says so `quantity` and `surface`.

    `file`: its caption file. `surfaces`: the labels of the surfaces by name. What the name has
    beyond that of its kind and is neither a quantity nor a surface follows the title.
    """
    kind = Path(file).stem
    rest = name.removeprefix(kind).removeprefix("-")
    words = {"what": read(file).title}
    quantity = next((part for part in (rest, *kind.split("-")) if part in QUANTITIES), None)
    if quantity:
        words["quantity"] = QUANTITIES[quantity].label
    if rest in surfaces:
        words["surface"] = surfaces[rest]
    elif rest and rest != quantity:
        words["what"] += f" {rest}"
    return words


def distinct(labels: dict[str, str]) -> dict[str, str]:
    """Labels by name, with the name in brackets where two are equal."""
    shown = list(labels.values())
    return {
        name: label if shown.count(label) == 1 else f"{label} ({name})"
        for name, label in labels.items()
    }
