# In: errors of all variants, trials. Out: the paper's claims, decided for every surface, diagonal
# and reading, products of readings included; their summary; slopes on shrinking rings; the answer
# for the README.


rule claims:
    input:
        errors=ERRORS,
        noise=NOISE,
        rings=RINGS,
    output:
        claims=study.results / "tables/claims.csv",
        summary=tabled("claims-summary"),
        rings=study.results / "tables/rings.csv",
        answer=study.results / "tables/answer.md",
        words=study.results / "tables/answer-in-words.md",
    log:
        study.results / "logs/claims.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        readings=study.rows(study.all_readings() | study.products()),
        named=list(study.readings),
        singles=list(study.single_changes()),
        diagonals=study.diagonals,
        full=FULL,
        code=code("claims"),
    script:
        "../scripts/claims.py"
