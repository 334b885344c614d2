"""Style and saving of all figures; the same bytes each time."""

from pathlib import Path
from textwrap import wrap

import matplotlib

from curvlib.files import whole_file

# A decorator of drawing functions, whose settings end with the call.
in_style = matplotlib.rc_context(
    {
        "svg.hashsalt": "curvlib",  # a fixed salt for the ids of SVG elements, random by default
        "font.size": 9,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "legend.frameon": False,
    }
)

DPI = 200


@in_style
def save(figure, path) -> None:
    """Write a matplotlib Figure, whole or not at all, in the format that the path's suffix
    names."""
    kind = Path(path).suffix[1:]
    with whole_file(path) as part:
        metadata = {"Date": None} if kind == "svg" else None
        figure.savefig(part, format=kind, dpi=DPI, metadata=metadata)


def in_lines(words, most):
    """Text broken into as few lines of at most `most` letters as possible, of about equal length;
    powers and minus signs are typographic."""
    words = words.replace("^2", "²").replace(" -", " \N{MINUS SIGN}")
    whole = {"break_long_words": False, "break_on_hyphens": False}
    tries = [wrap(words, width, **whole) for width in range(1, most + 1)]
    return "\n".join(next(lines for lines in tries if len(lines) == len(tries[-1])))
