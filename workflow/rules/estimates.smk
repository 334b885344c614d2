# In: the meshes, an estimator's file. Out: its K and H at every vertex, once per set of options.
ESTIMATES = expand(study.results / "estimates/{estimator}.h5", estimator=ESTIMATORS)


rule estimate:
    input:
        library=LIBRARY,
    output:
        study.results / "estimates/{estimator}.h5",
    log:
        study.results / "logs/estimate/{estimator}.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        meshes=MESHES,
        estimator=lambda wildcards: ESTIMATORS[wildcards.estimator],
        variants=lambda wildcards: study.variants(ESTIMATORS[wildcards.estimator]),
        code=lambda wildcards: code("estimate", estimators.path(ESTIMATORS[wildcards.estimator])),
    script:
        "../scripts/estimate.py"
