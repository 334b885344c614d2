"""Run all estimators, as the best explanation has them, on all other meshes and in the trials."""

from itertools import chain

import pandas as pd

from curvlib.claims.explanations import BEST
from curvlib.comparison.run import COLUMNS, run_estimator, write_rows
from curvlib.comparison.trials import noise_table, ring_table
from curvlib.dataset.library import load_library
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    inputs, params, output = snakemake.input, snakemake.params, snakemake.output
    readings = pd.read_csv(inputs.readings)
    found = readings[readings.reading == BEST].set_index("estimator").variant
    runs = [
        (params.estimators[stem], {variant: params.variants[stem][variant]})
        for stem, variant in found.items()
    ]
    library = load_library(*inputs.library)
    others, noisy = library.only(params.meshes), library.only(params.noisy)
    errors = (run_estimator(*run, others, lambda key, run=run: run[1]) for run in runs)
    write_rows(output.errors, COLUMNS, chain.from_iterable(errors))
    noise_table(output.noise, runs, noisy)
    ring_table(output.rings, runs)
