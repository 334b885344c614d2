# In: the files of all estimators, the study's and others. Out: their errors and orders on irregular
# meshes of surfaces in closed form; a page of them, with the cost where throughput was measured. Not
# part of `all`: the study is about nine of them.
SURVEYED = list(dict.fromkeys([*estimators.names(), *study.estimators]))

# Measured apart, on its own machine: the page shows what is there.
MEASURED = [file for file in [study.results / "tables/throughput.csv"] if file.exists()]


rule estimator_errors:
    output:
        study.results / "tables/estimators.csv",
    log:
        study.results / "logs/estimator_errors.log",
    conda:
        "../envs/curvlib.yaml"
    threads: workflow.cores
    params:
        estimators=SURVEYED,
        code=code("estimator_errors", *map(estimators.path, SURVEYED)),
    script:
        "../scripts/estimator_errors.py"


rule estimators:
    input:
        rules.estimator_errors.output,
    output:
        study.results / "tables/estimators.md",
    log:
        study.results / "logs/estimators.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        estimators=SURVEYED,
        cost=MEASURED,
        code=code("estimators", *map(estimators.path, SURVEYED), *MEASURED),
    script:
        "../scripts/estimators.py"
