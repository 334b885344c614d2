"""Put one estimator, in its tabulated variants, through noise and shrinking rings."""

from curvlib.comparison.trials import noise_table, ring_table
from curvlib.dataset.library import load_library
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    params, output = snakemake.params, snakemake.output
    variants = {variant: params.variants[variant] for variant in params.tabulated}
    runs = [(params.estimator, variants)]
    meshes = load_library(*snakemake.input.library).only(params.meshes)
    noise_table(output.noise, runs, meshes)
    ring_table(output.rings, runs)
