"""Run one estimator, in all its variants, on every mesh of the library."""

from curvlib.comparison.run import run_estimator
from curvlib.dataset.library import load_library
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    params, output = snakemake.params, snakemake.output
    run_estimator(
        params.estimator,
        params.variants,
        params.everywhere,
        load_library(*snakemake.input.library).only(params.meshes),
        params.full,
        output.values,
        output.errors,
        code=params.code,
    )
