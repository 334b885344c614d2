"""Measure the errors of every estimator on irregular meshes of surfaces in closed form."""

from curvlib.comparison.survey import survey
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    table = survey(snakemake.params.estimators, snakemake.threads)
    table.to_csv(snakemake.output[0], index=False)
