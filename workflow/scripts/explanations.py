"""Search the joint reading that explains the paper best."""

import pandas as pd

from curvlib.claims.explanations import alternatives, explain, marginals, with_best
from curvlib.comparison import accuracy
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    params, output = snakemake.params, snakemake.output
    readings = pd.DataFrame(params.readings)
    tables = map(accuracy.read, snakemake.input.errors)
    rows = accuracy.by_variant(tables, readings, params.paper, params.paper)
    explanations = explain(readings, rows, accuracy.curves(rows, readings))
    explanations.to_csv(output.explanations, index=False)
    alternatives(explanations).to_csv(output.alternatives, index=False)
    marginals(explanations).to_csv(output.marginals, index=False)
    with_best(readings, explanations).to_csv(output.readings, index=False)
