"""Draw the benchmark: ranks, error against cost, under noise, and against n."""

import pandas as pd

from curvlib.benchmark.advice import SITUATIONS
from curvlib.catalogue import families
from curvlib.figures.benchmark import against_cost, against_n, matrix, under_noise
from curvlib.figures.style import save
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    files, params, put = snakemake.input, snakemake.params, snakemake.output
    errors, situations, cost = (
        pd.read_csv(files[name]) for name in ("errors", "situations", "cost")
    )
    labels = {situation.name: situation.label for situation in SITUATIONS}
    named = {name: families.module(name).LABEL for name in params.families}
    figures = {
        "matrix": matrix(situations, labels),
        "cost_K": against_cost(situations, cost, labels, "K"),
        "cost_H": against_cost(situations, cost, labels, "H"),
        "noise": under_noise(errors, params.kinds),
        "order": against_n(errors, params.families, named),
    }
    for name, figure in figures.items():
        for path in put[name]:
            save(figure, path)
