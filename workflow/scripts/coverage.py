"""How often standard errors cover errors: tables and figure."""

from curvlib.comparison.coverage import summary, table
from curvlib.figures.coverage import coverage_plot
from curvlib.figures.style import save
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    found = table(snakemake.params.resolutions, threads=snakemake.threads)
    found.to_csv(snakemake.output.table, index=False)
    summary(found).to_csv(snakemake.output.summary, index=False)
    for path in snakemake.output.figures:
        save(coverage_plot(found), path)
