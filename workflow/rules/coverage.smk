# In: nothing. Out: how often the standard errors of adaptive_fit cover its errors, tables and figure. Not
# part of `all`: the study is about the nine of 2003.


rule coverage:
    output:
        table=study.results / "tables/coverage.csv",
        summary=study.results / "tables/coverage-summary.csv",
        figures=expand(FIGURES / "coverage.{kind}", kind=["svg", "png"]),
    log:
        study.results / "logs/coverage.log",
    conda:
        "../envs/curvlib.yaml"
    threads: workflow.cores
    params:
        resolutions=study.frontier,
        code=code("coverage", *map(estimators.path, sorted(COMPARED))),
    script:
        "../scripts/coverage.py"
