# In: the tables. Out: mean absolute error against triangles for all surfaces, with the paper's
# Figures 3 to 6 among them, SVG and PNG.
FIGURES = study.results / "figures"


rule figures:
    input:
        [
            FIGURES / f"{figure}.{kind}"
            for quantity in "KH"
            for figure in error_figures(quantity)
            for kind in ("svg", "png")
        ],


for quantity in "KH":

    rule:
        name:
            f"error_plots_{quantity}"
        input:
            errors=rules.accuracy.output.errors,
            convergence=rules.accuracy.output.convergence,
        output:
            expand(
                FIGURES / "{figure}.{kind}",
                figure=error_figures(quantity),
                kind=["svg", "png"],
            ),
        log:
            study.results / f"logs/error_plots_{quantity}.log",
        conda:
            "../envs/curvlib.yaml"
        params:
            quantity=quantity,
            figures=error_figures(quantity),
            folder=FIGURES,
            estimators=ESTIMATORS,
            surfaces=SURFACES,
            code=code("error_plots", *map(estimators.path, study.estimators)),
        script:
            "../scripts/error_plots.py"
