"""A check of what a figure looks like in print."""

import itertools

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text

from curvlib.figures.style import TEXT_WIDTH

LEAST = 6.5  # points


@pytest.fixture
def printed():
    """A function that checks a figure: it is no wider than the article's text, its smallest letters
    have LEAST points, no text lies on another or beyond the edge."""
    return check


def check(figure):
    assert figure.get_figwidth() <= TEXT_WIDTH + 1e-9
    FigureCanvasAgg(figure).draw()
    # Text's own method: that of an annotation counts its arrow.
    boxes = {text: Text.get_window_extent(text) for text in seen(figure)}
    points = {text.get_text(): letters(text) for text in boxes}
    assert min(points.values()) >= LEAST, points
    point = figure.dpi / 72
    corners = np.array([box.extents for box in boxes.values()])
    edge = np.array([*figure.bbox.extents[:2] - point, *figure.bbox.extents[2:] + point])
    beyond = ((corners < edge)[:, :2] | (corners > edge)[:, 2:]).any(axis=1)
    assert not beyond.any(), [t.get_text() for t, out in zip(boxes, beyond) if out]
    for (one, a), (other, b) in itertools.combinations(boxes.items(), 2):
        # The boxes hold ascenders and descenders, which hardly ever meet.
        apart = not a.padded(-point / 2).overlaps(b.padded(-point / 2))
        assert apart, f"{one.get_text()!r} lies on {other.get_text()!r}"


def seen(figure):
    """The texts of a figure, without labels of ticks beyond the axes."""
    hidden = set()
    for axes in figure.findobj(lambda artist: hasattr(artist, "xaxis")):
        for axis in (axes.xaxis, axes.yaxis):
            low, high = sorted(axis.get_view_interval())
            for tick in [*axis.get_major_ticks(), *axis.get_minor_ticks()]:
                shown = axes.axison and low <= tick.get_loc() <= high
                hidden |= set() if shown else {tick.label1, tick.label2}
    texts = [t for t in figure.findobj(Text) if t.get_visible() and t not in hidden]
    return [text for text in texts if text.get_text().strip()]


def letters(text):
    """Points of the smallest letters of a text: exponents and subscripts are set at 70 %."""
    words = text.get_text()
    small = "$" in words and ("^" in words or "_" in words)
    return text.get_fontsize() * (0.7 if small else 1)
