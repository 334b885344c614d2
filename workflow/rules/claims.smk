# In: the tables by variant, and what a reading is. Out: the paper's claims, decided for every surface,
# diagonal and reading, products of readings included; their summary; the answer for the README.


rule claims:
    input:
        readings=rules.accuracy.output.readings,
        variants=rules.accuracy.output.variants,
        curves=rules.accuracy.output.curves,
        noise=rules.accuracy.output.noise,
        rings=rules.accuracy.output.rings,
    output:
        claims=study.results / "tables/claims.csv",
        summary=tabled("claims-summary"),
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
