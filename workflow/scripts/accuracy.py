"""Compare the estimates with the exact values: errors, convergence, ranks, the answer."""

from pathlib import Path

from curvlib import accuracy
from curvlib.job import logged
from curvlib.library import load_library
from curvlib.results import read_estimates

with logged(snakemake.log[0]):
    meshes = load_library(*snakemake.input.library).only(snakemake.params.meshes)
    estimates = zip(snakemake.params.variants, map(read_estimates, snakemake.input.estimates))
    tables = accuracy.tables(meshes, dict(estimates), snakemake.params.variants)
    for name, table in tables.items():
        table.to_csv(snakemake.output[name], index=False)
    Path(snakemake.output.answer).write_text(accuracy.answer(**tables))
