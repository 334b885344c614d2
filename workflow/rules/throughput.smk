# In: nothing. Out: vertices per second and peak memory of the estimators and of what is
# installed of their peers, table and figure; points per second of exact curvature. Not part of
# `all`: every machine has its own.


rule throughput:
    output:
        table=study.results / "tables/throughput.csv",
        exact=study.results / "tables/throughput-exact.csv",
        figure=drawn(["throughput"], HOW_FAST, kinds=["svg"])[0],
    log:
        study.results / "logs/throughput.log",
    conda:
        "../envs/curvlib.yaml"
    # Alone on the machine: what runs beside it would be measured too.
    threads: workflow.cores
    params:
        sizes=[100, 316, 1000],
        code=code("throughput", *map(estimators.path, study.estimators)),
    script:
        "../scripts/throughput.py"
