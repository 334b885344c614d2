"""The figure of the coverage of standard errors."""

import numpy as np
import pandas as pd

from curvlib.figures.coverage import coverage_plot


def test_it_shows_means_over_surfaces_and_nominal_lines(printed):
    cases = [
        *(("white", level, 50) for level in (1e-4, 1e-2)),
        *((kind, 0.05, 50) for kind in ("isotropic", "half", "correlated", "quantised", "voxels")),
        *(("none", 0.0, n) for n in (25, 50, 100)),
    ]
    rows = [
        {"surface": s, "n": n, "noise": kind, "level": level, "quantity": q}
        | {"within_1": part, "within_2": part + 0.2}
        for q in ("K", "H")
        for kind, level, n in cases
        for s, part in (("a", 0.5), ("b", 0.7))
    ]
    figure = coverage_plot(pd.DataFrame(rows))
    assert len(figure.axes) == 6
    for axes in figure.axes:
        heights = {round(float(y), 3) for line in axes.lines for y in np.asarray(line.get_ydata())}
        assert heights == {0.683, 0.954, 0.6, 0.8}
        assert axes.get_xscale() == "log"
    assert [t.get_text() for t in figure.axes[2].get_legend().texts][-1] == "voxels"
    printed(figure)
