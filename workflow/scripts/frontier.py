"""Typeset the article on the estimators past 2003 from the results of this run."""

import csv

from curvlib.comparison.frontier import constants
from curvlib.comparison.references import ELSEWHERE
from curvlib.study import article, captions
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    params = snakemake.params
    with ELSEWHERE.open(newline="", encoding="utf-8") as file:
        elsewhere = list(csv.DictReader(file))
    article.typeset(
        params.article,
        snakemake.output[0],
        params.results,
        labels={},
        captions={figure: captions.read(file).text for figure, file in params.captions.items()},
        citation=snakemake.input.citation,
        resolutions=list(params.resolutions),
        elsewhere=elsewhere,
        constants=constants(),
        covered=params.covered,
    )
