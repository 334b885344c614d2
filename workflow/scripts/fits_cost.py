"""Measure what fits cost beside libigl, and what their time goes to."""

from curvlib.comparison.cost import cost, phases
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    cost(snakemake.params.side).to_csv(snakemake.output.cost, index=False)
    phases(snakemake.params.side).to_csv(snakemake.output.cost_phases, index=False)
