"""Measure estimators and peers on exact vertices."""

from curvlib.comparison.frontier import accuracy, installed
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    installed().to_csv(snakemake.output.peers, index=False)
    accuracy(snakemake.params.resolutions).to_csv(snakemake.output.accuracy, index=False)
