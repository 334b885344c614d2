"""Run one estimator, in the variants of the readings that are tabulated, on all other meshes."""

from curvlib.comparison.run import COLUMNS, run_estimator, write_rows
from curvlib.dataset.library import load_library
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    params, full = snakemake.params, set(snakemake.params.full)
    rows = run_estimator(
        params.estimator,
        params.variants,
        load_library(*snakemake.input.library).only(params.meshes),
        lambda key: params.tabulated if key in full else params.everywhere,
    )
    write_rows(snakemake.output.errors, COLUMNS, rows)
