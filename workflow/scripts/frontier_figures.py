"""Draw the figures of the article on the estimators past 2003."""

import pandas as pd

from curvlib.figures import fits
from curvlib.figures.style import save
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    tables = {name: pd.read_csv(file) for name, file in snakemake.input.items()}
    accuracy = tables["accuracy"]
    drawn = {
        "fits-noise": fits.noise_plot(tables["adaptive"]),
        "fits-order": fits.order_plot(accuracy, ["pear", "bump"], "H"),
        "fits-cost": fits.cost_plot(accuracy, tables["cost"], tables["peers"]),
        "fits-ablation": fits.ablation_plot(tables["ablation_jets"], tables["ablation_compact"]),
        "fits-map": fits.where_plot(tables["map"]),
    }
    for name in snakemake.params.figures:
        for kind in ("svg", "png"):
            save(drawn[name], f"{snakemake.params.folder}/{name}.{kind}")
