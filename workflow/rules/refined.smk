# In: the other meshes, finer or cut otherwise; what a reading is; an estimator's file. Out: its errors
# there in the readings that are tabulated, the best explanation among them; its errors in the trials:
# noise, and shrinking rings.
OTHERS = Rows(mesh for mesh in MESHES if mesh not in PAPER)
REFINED = expand(study.results / "refined/{estimator}.csv", estimator=ESTIMATORS)
NOISE = expand(study.results / "trials/noise-{estimator}.csv", estimator=ESTIMATORS)
RINGS = expand(study.results / "trials/rings-{estimator}.csv", estimator=ESTIMATORS)

# Noise is put on the paper's meshes nearest to these resolutions.
NOISY_N = {min(study.resolutions, key=lambda n: abs(n - wanted)) for wanted in (16, 32)}
NOISY = Rows(mesh for mesh in PAPER if mesh.n in NOISY_N)


rule refine:
    input:
        library=files_of(OTHERS),
        readings=rules.explanations.output.readings,
    output:
        errors=study.results / "refined/{estimator}.csv",
    log:
        study.results / "logs/refine/{estimator}.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        meshes=OTHERS,
        full=FULL,
        estimator=lambda wildcards: ESTIMATORS[wildcards.estimator],
        variants=lambda wildcards: study.variants(ESTIMATORS[wildcards.estimator]),
        code=lambda wildcards: code("refine", estimators.path(ESTIMATORS[wildcards.estimator])),
    script:
        "../scripts/refine.py"


rule trials:
    input:
        library=files_of(NOISY),
        readings=rules.explanations.output.readings,
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
