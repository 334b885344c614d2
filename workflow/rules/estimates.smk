# In: the meshes with the paper's resolutions and cut, an estimator's file. Out: its errors there, once
# per set of options, joint readings included, and its values in the default reading.
ERRORS = expand(study.results / "estimates/{estimator}.csv", estimator=ESTIMATORS)


rule estimate:
    input:
        library=files_of(PAPER),
    output:
        values=study.results / "estimates/{estimator}.h5",
        errors=study.results / "estimates/{estimator}.csv",
    log:
        study.results / "logs/estimate/{estimator}.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        meshes=PAPER,
        estimator=lambda wildcards: ESTIMATORS[wildcards.estimator],
        variants=lambda wildcards: VARIANTS[wildcards.estimator],
        code=lambda wildcards: code("estimate", estimators.path(ESTIMATORS[wildcards.estimator])),
    script:
        "../scripts/estimate.py"
