"""Compare what was aimed at with what was measured."""

import pandas as pd

from curvlib.comparison.frontier import summary
from curvlib.comparison.moonshots import moonshots
from curvlib.comparison.targets import targets
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    tables = {name: pd.read_csv(file) for name, file in snakemake.input.items()}
    accuracy, cost = tables["accuracy"], tables["cost"]
    summary(accuracy).to_csv(snakemake.output.summary, index=False)
    found = targets(accuracy, cost, tables["adaptive_ratios"], tables["voxel"])
    found.to_csv(snakemake.output.targets, index=False)
    parts = (tables[name] for name in ("hessians", "half", "contraction", "boundary"))
    moonshots(*parts, cost).to_csv(snakemake.output.moonshots, index=False)
