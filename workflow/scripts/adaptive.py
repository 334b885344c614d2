"""Compare adaptive_fit with fixed fits on noisy meshes."""

from curvlib.comparison.adaptive import ratios, table
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    errors = table(snakemake.params.n, threads=snakemake.threads)
    errors.to_csv(snakemake.output.table, index=False)
    ratios(errors).to_csv(snakemake.output.ratios, index=False)
