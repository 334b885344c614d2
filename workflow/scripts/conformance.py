"""Check functions of other libraries, and our estimators, and say what a user has to do."""

from pathlib import Path

from curvlib.conformance.cells import table
from curvlib.conformance.page import page
from curvlib.figures.conformance import conformance_plot
from curvlib.figures.style import save
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    verdicts = table(threads=snakemake.threads)
    verdicts.to_csv(snakemake.output.table, index=False)
    Path(snakemake.output.page).write_text(page(verdicts.astype(object)), encoding="utf-8")
    for path in snakemake.output.figures:
        save(conformance_plot(verdicts), path)
