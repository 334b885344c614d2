"""Put one estimator, in its tabulated variants, through noise and shrinking rings."""

from curvlib.comparison.run import write_rows
from curvlib.comparison.trials import NOISE_COLUMNS, RING_COLUMNS, noise_rows, ring_rows
from curvlib.dataset.library import load_library
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    params, name = snakemake.params, {"estimator": snakemake.wildcards.estimator}
    variants = {variant: params.variants[variant] for variant in params.tabulated}
    meshes = load_library(*snakemake.input.library).only(params.meshes)
    noise = (
        {**name, **row}
        for key, mesh in meshes.items()
        for row in noise_rows(key, mesh, params.estimator, variants)
    )
    write_rows(snakemake.output.noise, ("estimator", *NOISE_COLUMNS), noise)
    rings = ({**name, **row} for row in ring_rows(params.estimator, variants))
    write_rows(snakemake.output.rings, ("estimator", *RING_COLUMNS), rings)
