"""Measure the errors of all estimators on a family of meshes, or under a kind of noise."""

from curvlib.benchmark.errors import CAUSES, COLUMNS, measured
from curvlib.benchmark.plan import Plan
from curvlib.comparison.run import write_rows
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    errors, causes = measured(Plan(snakemake.input[0]), snakemake.wildcards.part)
    write_rows(snakemake.output.errors, COLUMNS, errors)
    write_rows(snakemake.output.causes, CAUSES, causes)
