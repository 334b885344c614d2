"""Draw the claims by surface, ranks, and errors on shrinking rings."""

import pandas as pd

from curvlib.catalogue import estimators, surfaces
from curvlib.claims.cell import chosen
from curvlib.claims.summary import verdicts
from curvlib.comparison.accuracy import concat
from curvlib.figures.curves import rank_plot
from curvlib.figures.rings import rings_plot
from curvlib.figures.style import save
from curvlib.figures.verdicts import claims_map
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    inputs, params = snakemake.input, snakemake.params
    claims, summary, ranks, slopes = map(pd.read_csv, inputs[:4])
    rings = concat(map(pd.read_csv, inputs.rings))
    modules = estimators.modules(params.estimators) | surfaces.modules(params.surfaces)
    shown = chosen(params.surfaces)
    drawn = {"claims": claims_map(verdicts(claims), summary, shown, modules)}
    for quantity in params.quantities:
        drawn[f"ranks-{quantity}"] = rank_plot(ranks, quantity, shown, modules, params.n)
        drawn[f"rings-{quantity}"] = rings_plot(rings, slopes, params.rings, quantity)
    for name, figure in drawn.items():
        for kind in ("svg", "png"):
            save(figure, f"{params.folder}/{name}.{kind}")
