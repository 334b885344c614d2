"""Run one estimator, in all its variants, on the paper's meshes."""

from curvlib.comparison.run import run_and_keep
from curvlib.dataset.library import load_library
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    params, output = snakemake.params, snakemake.output
    run_and_keep(
        params.estimator,
        params.variants,
        load_library(*snakemake.input.library).only(params.meshes),
        output.errors,
        output.values,
        code=params.code,
    )
