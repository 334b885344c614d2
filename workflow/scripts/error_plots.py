"""Draw mean absolute error against triangles, one figure per surface."""

import pandas as pd

from curvlib.catalogue import estimators, surfaces
from curvlib.figures.curves import error_plot
from curvlib.figures.style import save
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    params = snakemake.params
    errors, convergence = map(pd.read_csv, snakemake.input)
    modules = estimators.modules(params.estimators) | surfaces.modules(params.surfaces)
    for figure, (surface, resolutions) in params.figures.items():
        points = errors[errors.n.isin(resolutions)]
        drawn = error_plot(points, convergence, surface, params.quantity, modules)
        for kind in ("svg", "png"):
            save(drawn, f"{params.folder}/{figure}.{kind}")
