# In: nothing. Out: errors of adaptive_fit and of every fixed fit on noisy meshes of surfaces in closed
# form, and their ratios by kind of noise. Not part of `all`: the study is about the nine of 2003.


COMPARED = {"adaptive_fit", "ball_regression", "compact_hermite", "jet"} & set(estimators.names())


rule adaptive:
    output:
        table=study.results / "tables/adaptive.csv",
        ratios=study.results / "tables/adaptive-ratios.csv",
    log:
        study.results / "logs/adaptive.log",
    conda:
        "../envs/curvlib.yaml"
    threads: workflow.cores
    params:
        n=study.frontier[min(1, len(study.frontier) - 1)],
        code=code("adaptive", *map(estimators.path, sorted(COMPARED))),
    script:
        "../scripts/adaptive.py"
