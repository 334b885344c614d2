"""Draw the map of readings: a specification curve per claim."""

import pandas as pd

from curvlib.claims.cell import chosen
from curvlib.figures.readings import specification_curve
from curvlib.figures.style import save
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    params = snakemake.params
    claims, summary = map(pd.read_csv, snakemake.input)
    shown = chosen(params.surfaces)
    for claim in summary.itertuples():
        about = claim, shown, claim.limit, params.marked
        drawn = specification_curve(claims, params.readings, *about)
        for kind in ("svg", "png"):
            save(drawn, f"{params.folder}/readings-claim-{claim.claim}.{kind}")
