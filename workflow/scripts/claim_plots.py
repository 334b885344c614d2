"""Draw the claims by surface, ranks, and errors on shrinking rings."""

import pandas as pd

from curvlib.catalogue import estimators, surfaces
from curvlib.claims import evidence
from curvlib.claims.sentences import chosen
from curvlib.figures import curves as figures
from curvlib.figures import verdicts as claim_figures
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    inputs, params = snakemake.input, snakemake.params
    claims, summary, ranks, slopes = map(pd.read_csv, inputs[:4])
    rings = pd.concat(map(pd.read_csv, inputs.rings))
    modules = estimators.modules(params.estimators) | surfaces.modules(params.surfaces)
    shown = chosen(params.surfaces)
    verdicts = evidence.verdicts(claims, params.diagonal)[shown]
    drawn = {"claims": claim_figures.claims_map(verdicts, summary, modules)}
    for quantity in "KH":
        drawn[f"ranks-{quantity}"] = figures.rank_plot(ranks, quantity, shown, modules, params.n)
        drawn[f"rings-{quantity}"] = claim_figures.rings_plot(rings, slopes, params.rings, quantity)
    for name, figure in drawn.items():
        for kind in ("svg", "png"):
            figures.save(figure, f"{params.folder}/{name}.{kind}")
