# In: the answer and a figure. Out: the same in README.md and beside the paper, so that a reader
# sees them before the first run. Not part of `all`: it changes tracked files.


rule readme:
    input:
        answer=rules.claims.output.answer,
        figure=FIGURES / "figure-6.svg",
    log:
        study.results / "logs/readme.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        readme=f"{workflow.basedir}/README.md",
        figure=f"{workflow.basedir}/paper/readme-figure.svg",
    script:
        "../scripts/readme.py"
