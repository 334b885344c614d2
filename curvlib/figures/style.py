"""Style and saving of all figures; the same bytes each time."""

from pathlib import Path
from textwrap import wrap

import matplotlib

from curvlib.files import whole_file

# Figures have the size at which the article shows them, so that their points are points in print.
TEXT_WIDTH = 160 / 25.4  # inches: the width of the article's text
PIXELS = 1400  # across the text
DPI = PIXELS / TEXT_WIDTH
# Points: of the smallest text, and of text with exponents, which are set at 70 %: 6.5 points.
SMALL, WITH_EXPONENTS = 7, 9.3

# A decorator of drawing functions, whose settings end with the call.
in_style = matplotlib.rc_context(
    {
        "svg.hashsalt": "curvlib",  # a fixed salt for the ids of SVG elements, random by default
        "font.size": 8,
        "axes.titlesize": 8.5,
        "xtick.labelsize": WITH_EXPONENTS,
        "ytick.labelsize": WITH_EXPONENTS,
        "hatch.linewidth": 0.5,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "legend.frameon": False,
        "legend.fontsize": 7.5,
    }
)

# Fills a place where there is nothing to rank.
NO_RANK = {"facecolor": "white", "edgecolor": "0.72", "hatch": "//////", "linewidth": 0}


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
