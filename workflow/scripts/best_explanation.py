"""Run all estimators, as the best explanation has them, on all other meshes and in the trials."""

import pandas as pd

from curvlib.claims.explanations import BEST
from curvlib.comparison.run import COLUMNS, run_estimator, write_rows
from curvlib.comparison.trials import NOISE_COLUMNS, RING_COLUMNS, noise_rows, ring_rows
from curvlib.dataset.library import load_library
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    inputs, params, output = snakemake.input, snakemake.params, snakemake.output
    readings = pd.read_csv(inputs.readings)
    found = readings[readings.reading == BEST].set_index("estimator").variant
    runs = [
        (stem, params.estimators[stem], {variant: params.variants[stem][variant]})
        for stem, variant in found.items()
    ]
    library = load_library(*inputs.library)
    others, noisy = library.only(params.meshes), library.only(params.noisy)
    errors = (
        row
        for _, estimator, variants in runs
        for row in run_estimator(estimator, variants, others, lambda key, v=variants: v)
    )
    write_rows(output.errors, COLUMNS, errors)
    noise = (
        {"estimator": stem, **row}
        for stem, estimator, variants in runs
        for key, mesh in noisy.items()
        for row in noise_rows(key, mesh, estimator, variants)
    )
    write_rows(output.noise, ("estimator", *NOISE_COLUMNS), noise)
    rings = (
        {"estimator": stem, **row}
        for stem, estimator, variants in runs
        for row in ring_rows(estimator, variants)
    )
    write_rows(output.rings, ("estimator", *RING_COLUMNS), rings)
