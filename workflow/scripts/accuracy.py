"""Tables of errors, convergence and ranks, by variant and by reading; of noise and of rings."""

import pandas as pd

from curvlib.comparison import accuracy
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    inputs, params, output = snakemake.input, snakemake.params, snakemake.output
    readings = pd.read_csv(inputs.readings)
    tables = map(accuracy.read, inputs.errors)
    rows = accuracy.by_variant(tables, readings, params.full, params.paper)
    curves = accuracy.curves(rows, readings)
    tabulated = readings[readings.kind != "product"]
    errors = accuracy.errors(rows, tabulated)
    tables = {
        "variants": rows,
        "curves": curves,
        "errors": errors,
        "convergence": accuracy.convergence(curves, tabulated),
        "ranks": accuracy.ranks(errors, rows),
        "noise": accuracy.concat(map(accuracy.read, inputs.noise)),
        "rings": accuracy.ring_slopes(accuracy.concat(map(accuracy.read, inputs.rings))),
    }
    for name, table in tables.items():
        table.to_csv(output[name], index=False)
