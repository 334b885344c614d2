"""Measure what the estimators of the benchmark cost."""

from curvlib.benchmark.cost import cost
from curvlib.benchmark.plan import Plan
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    cost(Plan(snakemake.input[0])).to_csv(snakemake.output.cost, index=False)
