"""Measure how many vertices per second the estimators and their peers do."""

import pandas as pd

from curvlib.figures import save, throughput_plot
from curvlib.job import logged
from curvlib.throughput import rows

with logged(snakemake.log[0]):
    table = pd.DataFrame(rows(snakemake.params.sizes))
    table.to_csv(snakemake.output.table, index=False)
    save(throughput_plot(table), snakemake.output.figure)
