"""What all pictures share: symbols, units, and how they are saved; the same bytes each time."""

from pathlib import Path
from textwrap import wrap

import matplotlib
from matplotlib.figure import Figure

# SVG names its elements from this salt instead of at random.
matplotlib.rcParams.update(
    {
        "svg.hashsalt": "curvlib",
        "font.size": 9,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "legend.frameon": False,
    }
)


DPI = 200


UNITS = {"K": "1/length²", "H": "1/length"}


SYMBOLS = {"K": "K", "H": "|H|"}


NAMES = {"K": "Gaussian curvature K", "H": "mean curvature H"}


def save(figure: Figure, path) -> None:
    """Write a figure in the format that the path's suffix names."""
    kind = Path(path).suffix[1:]
    figure.savefig(path, dpi=DPI, metadata={"Date": None} if kind == "svg" else None)


def in_lines(words, most):
    """Words in as few lines of at most `most` letters as hold them, all about as long; powers and
    signs as printed."""
    words = words.replace("^2", "²").replace(" -", " \N{MINUS SIGN}")
    whole = {"break_long_words": False, "break_on_hyphens": False}
    tries = [wrap(words, width, **whole) for width in range(1, most + 1)]
    return "\n".join(next(lines for lines in tries if len(lines) == len(tries[-1])))
