# In: nothing, and the tables of adaptive.smk. Out: the article on the estimators past 2003, results/paper/
# frontier.pdf, with tables and figures in results/frontier. Not part of `all`: the study is about the nine
# of 2003.
FRONTIER = study.results / "frontier"
FITS = ("adaptive_fit", "ball_regression", "compact_hermite", "jet")
# Without them there is nothing to write about.
FITTED = [estimators.path(name) for name in FITS if name in estimators.names()]
fitted = partial(tables_in, FRONTIER)


rule fits_accuracy:
    output:
        **fitted("accuracy", "peers"),
    log:
        study.results / "logs/fits_accuracy.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        resolutions=study.frontier,
        code=code("fits_accuracy", *map(estimators.path, estimators.names())),
    script:
        "../scripts/fits_accuracy.py"


rule fits_parts:
    output:
        **fitted(
            "ablation-jets",
            "ablation-compact",
            "contraction",
            "boundary",
            "hessians",
            "half",
            "map",
            "measures",
            "voxel",
        ),
    log:
        study.results / "logs/fits_parts.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        resolutions=study.frontier,
        code=code("fits_parts", *FITTED),
    script:
        "../scripts/fits_parts.py"


rule fits_cost:
    output:
        **fitted("cost", "cost-phases"),
    log:
        study.results / "logs/fits_cost.log",
    conda:
        "../envs/curvlib.yaml"
    # Alone on the machine: what runs beside it takes cache and bandwidth.
    threads: workflow.cores
    params:
        # The mesh has about 200,000 vertices.
        side=9 * study.frontier[min(1, len(study.frontier) - 1)],
        code=code("fits_cost", *map(estimators.path, estimators.names())),
    script:
        "../scripts/fits_cost.py"


rule fits_targets:
    input:
        **rules.fits_accuracy.output,
        **rules.fits_cost.output,
        **rules.fits_parts.output,
        adaptive_ratios=rules.adaptive.output.ratios,
    output:
        **fitted("summary", "targets", "moonshots"),
    log:
        study.results / "logs/fits_targets.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        code=code("fits_targets"),
    script:
        "../scripts/fits_targets.py"


FITS_DRAWN = ["fits-noise", "fits-order", "fits-cost", "fits-ablation", "fits-map"]


rule frontier_figures:
    input:
        **{
            name: FRONTIER / f"tables/{name.replace('_', '-')}.csv"
            for name in ("accuracy", "cost", "peers", "ablation_jets", "ablation_compact", "map")
        },
        adaptive=rules.adaptive.output.table,
    output:
        expand(FRONTIER / "figures/{figure}.{kind}", figure=FITS_DRAWN, kind=["svg", "png"]),
    log:
        study.results / "logs/frontier_figures.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        figures=FITS_DRAWN,
        folder=FRONTIER / "figures",
        code=code("frontier_figures"),
    script:
        "../scripts/frontier_figures.py"


FRONTIER_ARTICLE = Path(HOUSE, "paper/frontier.typ")

# Measured apart: the article shows what is there.
COVERED = [file for file in [study.results / "tables/coverage-summary.csv"] if file.exists()]


rule frontier:
    input:
        COVERED,
        rules.frontier_figures.output,
        rules.fits_accuracy.output,
        rules.fits_cost.output,
        rules.fits_parts.output,
        rules.fits_targets.output,
        rules.adaptive.output,
        [file for kind in ("typ", "bib") for file in sorted(ARTICLE.parent.glob(f"*.{kind}"))],
        [caption(figure) for figure in FITS_DRAWN],
        citation=f"{HOUSE}/CITATION.cff",
    output:
        study.results / "paper/frontier.pdf",
    log:
        study.results / "logs/frontier.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        article=FRONTIER_ARTICLE,
        results=study.results,
        captions=Named({figure: caption(figure) for figure in FITS_DRAWN}),
        resolutions=study.frontier,
        covered=bool(COVERED),
        code=code("frontier"),
    script:
        "../scripts/frontier.py"
