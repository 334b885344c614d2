"""What all pictures share: how they look, and how they are saved; the same bytes each time."""

from pathlib import Path
from textwrap import wrap

import matplotlib

from curvlib.files import whole_file

# A decorator of what draws: its settings hold inside, and nobody else's matplotlib changes.
in_style = matplotlib.rc_context(
    {
        "svg.hashsalt": "curvlib",  # names of SVG elements from this salt instead of at random
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
    """Words in as few lines of at most `most` letters as hold them, all about as long; powers and
    signs as printed."""
    words = words.replace("^2", "²").replace(" -", " \N{MINUS SIGN}")
    whole = {"break_long_words": False, "break_on_hyphens": False}
    tries = [wrap(words, width, **whole) for width in range(1, most + 1)]
    return "\n".join(next(lines for lines in tries if len(lines) == len(tries[-1])))
