"""Run one estimator, in all its variants, on every mesh of the library."""

from curvlib.estimation import estimate
from curvlib.job import logged
from curvlib.library import load_library
from curvlib.results import write_estimates

with logged(snakemake.log[0]):
    params = snakemake.params
    meshes = load_library(*snakemake.input.library).only(snakemake.params.meshes)
    write_estimates(
        snakemake.output[0],
        (
            (key, variant, estimate(mesh, params.estimator, **options))
            for key, mesh in meshes.items()
            for variant, options in params.variants.items()
        ),
        code=params.code,
    )
