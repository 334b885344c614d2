"""Put one estimator, in all its variants, through noise and shrinking rings."""

from curvlib.job import logged
from curvlib.library import load_library
from curvlib.results import write_rows
from curvlib.trials import noise_rows, ring_rows

with logged(snakemake.log[0]):
    params, name = snakemake.params, {"estimator": snakemake.wildcards.estimator}
    meshes = load_library(*snakemake.input.library)
    noise = (
        {"surface": surface, **name, **row}
        for surface in meshes.surfaces()
        for row in noise_rows(meshes[surface, *params.mesh], params.estimator, params.variants)
    )
    write_rows(snakemake.output.noise, noise)
    rings = ({**name, **row} for row in ring_rows(params.estimator, params.variants))
    write_rows(snakemake.output.rings, rings)
