"""Run one estimator, in all its variants, on the paper's meshes."""

from curvlib.comparison.run import run_estimator
from curvlib.dataset.library import load_library
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    params, output = snakemake.params, snakemake.output
    run_estimator(
        params.estimator,
        params.variants,
        load_library(*snakemake.input.library).only(params.meshes),
        lambda key: params.variants,
        output.errors,
        output.values,
        code=params.code,
    )
