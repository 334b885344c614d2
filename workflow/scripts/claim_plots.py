"""Draw the claims by surface and by option, ranks and how alike they are, and errors on shrinking
rings."""

import pandas as pd

from curvlib.catalogue import estimators, surfaces
from curvlib.claims.cell import SIMILAR_PAIRS, chosen
from curvlib.claims.explanations import BEST, RANKING, best
from curvlib.claims.summary import verdicts
from curvlib.comparison.accuracy import concat
from curvlib.figures.agreement import agreement_plot
from curvlib.figures.curves import rank_plot
from curvlib.figures.marginals import marginals_plot
from curvlib.figures.rings import rings_plot
from curvlib.figures.style import save
from curvlib.figures.verdicts import claims_map
from curvlib.study.job import logged

TITLES = {"default": "default reading", BEST: "best explanation"}
BY_OPTION = (*RANKING, 11)  # what follows from the ranking, beside it

with logged(snakemake.log[0]):
    inputs, params = snakemake.input, snakemake.params
    tables = ("claims", "summary", "agreement", "explanations", "marginals", "ranks", "slopes")
    claims, summary, agreement, explanations, marginals, ranks, slopes = (
        pd.read_csv(inputs[table]) for table in tables
    )
    rings = concat(map(pd.read_csv, inputs.rings))
    modules = estimators.modules(params.estimators) | surfaces.modules(params.surfaces)
    shown = chosen(params.surfaces)
    titles = {reading: TITLES[reading] for reading in TITLES if reading in set(claims.reading)}
    beside = dict(SIMILAR_PAIRS)
    alike = dict.fromkeys(s for first in shown for s in (first, beside.get(first)) if s in shown)
    sentences = summary.set_index("claim").sentence
    by_option = {claim: sentences[claim] for claim in BY_OPTION if claim in sentences}
    drawn = {
        "claims": claims_map(verdicts(claims, shown), summary, titles, shown, modules),
        "agreement": agreement_plot(agreement, titles, list(alike), modules),
        "marginals": marginals_plot(
            marginals, explanations, by_option, params.default, best(explanations)
        ),
    }
    for quantity in params.quantities:
        drawn[f"ranks-{quantity}"] = rank_plot(ranks, quantity, shown, modules, params.n)
        drawn[f"rings-{quantity}"] = rings_plot(rings, slopes, params.rings, quantity)
    for name, figure in drawn.items():
        for kind in ("svg", "png"):
            save(figure, f"{params.folder}/{name}.{kind}")
