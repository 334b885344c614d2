"""Errors, convergence and ranks of every reading, from the errors of every variant."""

import pandas as pd

from curvlib.comparison import accuracy
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    params, output = snakemake.params, snakemake.output
    readings = pd.DataFrame(params.readings)
    rows = accuracy.by_variant(map(pd.read_csv, snakemake.input), set(map(tuple, params.full)))
    errors = accuracy.errors(rows, readings)
    readings.to_csv(output.readings, index=False)
    errors.to_csv(output.errors, index=False)
    accuracy.by_reading(rows, readings).to_csv(output.convergence, index=False)
    levels = accuracy.rounding_levels(rows)
    accuracy.ranks(errors, levels).to_csv(output.ranks, index=False)
