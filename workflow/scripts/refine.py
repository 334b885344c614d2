"""Run one estimator, in the variants of the readings that are tabulated, on all other meshes."""

import pandas as pd

from curvlib.comparison.run import run_estimator
from curvlib.dataset.library import load_library
from curvlib.study.job import logged
from curvlib.study.readings import tabulated

with logged(snakemake.log[0]):
    inputs, params = snakemake.input, snakemake.params
    full = set(params.full)
    on_full, everywhere = tabulated(pd.read_csv(inputs.readings), snakemake.wildcards.estimator)
    run_estimator(
        params.estimator,
        params.variants,
        load_library(*inputs.library).only(params.meshes),
        lambda key: on_full if key in full else everywhere,
        snakemake.output.errors,
    )
