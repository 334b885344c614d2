"""Run one estimator, in all its variants, on every mesh of the library."""

from curvlib.comparison.run import run_estimator
from curvlib.dataset.library import load_library
from curvlib.study.job import logged
from curvlib.surfaces._named import surface as load

with logged(snakemake.log[0]):
    params = snakemake.params
    run_estimator(
        params.estimator,
        params.variants,
        params.more,
        load_library(*snakemake.input.library).only(params.meshes),
        {name: load(file) for name, file in params.surfaces.items()},
        params.full,
        snakemake.output,
        code=params.code,
    )
