# In: the meshes, an estimator's file. Out: its errors on every mesh, once per set of options, its
# values in the default reading, and its errors in the trials: noise, and shrinking rings.
ERRORS = expand(study.results / "estimates/{estimator}.csv", estimator=ESTIMATORS)
NOISE = expand(study.results / "trials/noise-{estimator}.csv", estimator=ESTIMATORS)
RINGS = expand(study.results / "trials/rings-{estimator}.csv", estimator=ESTIMATORS)

# The cut that noise is put on: the first, at the resolution nearest to 16.
NOISY = min(FULL, key=lambda mesh: (mesh.diagonal != study.diagonals[0], abs(mesh.n - 16)))
NOISY = [MeshKey(surface, NOISY.diagonal, NOISY.n) for surface in SURFACES]


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
        meshes=MESHES,
        estimator=lambda wildcards: ESTIMATORS[wildcards.estimator],
        variants=lambda wildcards: study.variants(ESTIMATORS[wildcards.estimator]),
        everywhere=lambda wildcards: study.more_variants(ESTIMATORS[wildcards.estimator]),
        full=FULL,
        code=lambda wildcards: code("estimate", estimators.path(ESTIMATORS[wildcards.estimator])),
    script:
        "../scripts/estimate.py"


rule trials:
    input:
        library=files_of(NOISY),
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
        meshes=NOISY,
        code=lambda wildcards: code("trials", estimators.path(ESTIMATORS[wildcards.estimator])),
    script:
        "../scripts/trials.py"
