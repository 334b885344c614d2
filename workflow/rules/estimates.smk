# In: the meshes, an estimator's file. Out: its errors on every mesh, once per set of options, its
# values in the default reading, and its errors in the trials: noise, and shrinking rings.
ERRORS = expand(study.results / "estimates/{estimator}.csv", estimator=ESTIMATORS)
NOISE = expand(study.results / "trials/noise-{estimator}.csv", estimator=ESTIMATORS)
RINGS = expand(study.results / "trials/rings-{estimator}.csv", estimator=ESTIMATORS)


rule estimate:
    input:
        library=LIBRARY,
    output:
        values=study.results / "estimates/{estimator}.h5",
        errors=study.results / "estimates/{estimator}.csv",
    log:
        study.results / "logs/estimate/{estimator}.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        estimator=lambda wildcards: ESTIMATORS[wildcards.estimator],
        variants=lambda wildcards: study.variants(ESTIMATORS[wildcards.estimator]),
        surfaces=SURFACES,
        full=FULL,
        code=lambda wildcards: code("estimate", estimators.path(ESTIMATORS[wildcards.estimator])),
    script:
        "../scripts/estimate.py"


rule trials:
    input:
        library=LIBRARY,
    output:
        noise=study.results / "trials/noise-{estimator}.csv",
        rings=study.results / "trials/rings-{estimator}.csv",
    log:
        study.results / "logs/trials/{estimator}.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        estimator=lambda wildcards: ESTIMATORS[wildcards.estimator],
        variants=lambda wildcards: study.variants(ESTIMATORS[wildcards.estimator]),
        mesh=min(FULL, key=lambda mesh: (mesh[0] != study.diagonals[0], abs(mesh[1] - 16))),
        code=lambda wildcards: code("trials", estimators.path(ESTIMATORS[wildcards.estimator])),
    script:
        "../scripts/trials.py"
