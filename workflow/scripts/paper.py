"""Typeset the article from the results of this run."""

from curvlib import article
from curvlib.catalogue import estimators, surfaces
from curvlib.job import logged

with logged(snakemake.log[0]):
    params = snakemake.params
    labels = {name: estimators.module(file).LABEL for name, file in params.estimators.items()}
    labels |= {name: surfaces.module(file).LABEL for name, file in params.surfaces.items()}
    article.typeset(
        params.article,
        snakemake.output[0],
        params.results,
        labels=labels,
        captions={figure: article.caption(file) for figure, file in params.captions.items()},
        citation=snakemake.input.citation,
        **params.quoted,
    )
