"""Typeset the article from the results of this run."""

from curvlib.catalogue import estimators, surfaces
from curvlib.dataset.sums import library_digest
from curvlib.study import article, captions
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    params = snakemake.params
    modules = estimators.modules(params.estimators) | surfaces.modules(params.surfaces)
    article.typeset(
        params.article,
        snakemake.output[0],
        params.results,
        labels={name: module.LABEL for name, module in modules.items()},
        captions={figure: captions.read(file).text for figure, file in params.captions.items()},
        citation=snakemake.input.citation,
        meshes=library_digest(params.library, params.meshes),
        excerpts=article.excerpts(f"{params.results}/tables", article.EXCERPTS),
        **params.quoted,
    )
