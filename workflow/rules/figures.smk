# In: the tables. Out: mean absolute error against triangles for all surfaces, with the paper's
# Figures 3 to 6 among them, SVG and PNG; and what pictures.smk draws.
CLAIM_FIGURES = [
    "claims",
    "marginals",
    "agreement",
    *(f"{what}-{q}" for what in ("ranks", "rings") for q in PAPER_FIGURES),
]
ERROR_FIGURES = [figure for quantity in PAPER_FIGURES for figure in error_figures(study, quantity)]


rule figures:
    input:
        expand(
            FIGURES / "{figure}.{kind}",
            figure=[*ERROR_FIGURES, *CLAIM_FIGURES],
            kind=["svg", "png"],
        ),
        rules.pictures.output,
        rules.error_maps.output,


for quantity in PAPER_FIGURES:

    rule:
        name:
            f"error_plots_{quantity}"
        input:
            errors=rules.accuracy.output.errors,
            convergence=rules.accuracy.output.convergence,
        output:
            drawn(error_figures(study, quantity), ERRORS_FALL),
        log:
            study.results / f"logs/error_plots_{quantity}.log",
        conda:
            "../envs/curvlib.yaml"
        params:
            quantity=quantity,
            figures=Named(error_figures(study, quantity)),
            folder=FIGURES,
            estimators=ESTIMATORS,
            surfaces=SURFACES,
            code=code("error_plots", *MODULES),
        script:
            "../scripts/error_plots.py"


rule claim_plots:
    input:
        claims=rules.claims.output.claims,
        summary=rules.claims.output.summary,
        agreement=rules.claims.output.agreement,
        explanations=rules.explanations.output.explanations,
        marginals=rules.explanations.output.marginals,
        ranks=rules.accuracy.output.ranks,
        slopes=rules.accuracy.output.rings,
        rings=RINGS,
    output:
        drawn(CLAIM_FIGURES, HOLDS),
    log:
        study.results / "logs/claim_plots.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        quantities=list(PAPER_FIGURES),
        default={option: values[0] for option, values in study.choices().items()},
        n=study.resolutions[-1],
        rings=Rows(study.ring_curves()),
        folder=FIGURES,
        estimators=ESTIMATORS,
        surfaces=SURFACES,
        code=code("claim_plots", *MODULES),
    script:
        "../scripts/claim_plots.py"
