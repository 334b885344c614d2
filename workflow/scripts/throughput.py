"""Measure how many vertices per second the estimators and their peers do."""

import pandas as pd

from curvlib.catalogue import estimators
from curvlib.comparison.exact_throughput import exact_rows
from curvlib.comparison.throughput import rows
from curvlib.figures.style import save
from curvlib.figures.throughput import throughput_plot
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    table = pd.DataFrame(rows(snakemake.params.sizes))
    table.to_csv(snakemake.output.table, index=False)
    pd.DataFrame(exact_rows()).to_csv(snakemake.output.exact, index=False)
    modules = estimators.modules({name: name for name in estimators.names()})
    save(throughput_plot(table, modules), snakemake.output.figure)
