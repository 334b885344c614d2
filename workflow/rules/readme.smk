# In: the answer and a figure. Out: the same in README.md, CHANGELOG.md and beside the paper, so that
# a reader sees them before the first run. Not part of `all`: it changes tracked files.


rule readme:
    input:
        answers=[rules.claims.output.answer, rules.claims.output.words],
        figure=FIGURES / "figure-6.svg",
    log:
        study.results / "logs/readme.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        documents=[f"{HOUSE}/{name}" for name in ("README.md", "CHANGELOG.md")],
        figure=f"{HOUSE}/paper/readme-figure.svg",
    script:
        "../scripts/readme.py"
