# In: the tables by variant, what a reading is, what explains the paper. Out: the paper's claims, decided
# for every surface, diagonal and reading, on the paper's meshes and on others; their summary; the answer
# for the README.


rule claims:
    input:
        readings=rules.explanations.output.readings,
        variants=rules.accuracy.output.variants,
        curves=rules.accuracy.output.curves,
        noise=rules.accuracy.output.noise,
        rings=rules.accuracy.output.rings,
        explanations=rules.explanations.output.explanations,
        convergence=rules.accuracy.output.convergence,
        shapes=rules.shapes.output.shapes,
    output:
        claims=tabled("claims"),
        guesses=tabled("guesses"),
        agreement=tabled("agreement"),
        summary=tabled("claims-summary"),
        findings=study.results / "tables/findings.json",
        answer=study.results / "tables/answer.md",
        words=study.results / "tables/answer-in-words.md",
    log:
        study.results / "logs/claims.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        code=code("claims"),
    script:
        "../scripts/claims.py"
