# In: the other meshes, finer or cut otherwise; an estimator's file. Out: its errors there in the readings
# that are tabulated; its errors in the trials: noise, and shrinking rings. The same of all estimators
# as the best explanation has them, which only the run knows.
OTHERS = Rows(mesh for mesh in MESHES if mesh not in PAPER)

# Noise is put on the paper's meshes nearest to these resolutions.
NOISY_N = {min(study.resolutions, key=lambda n: abs(n - wanted)) for wanted in (16, 32)}
NOISY = Rows(mesh for mesh in PAPER if mesh.n in NOISY_N)


rule refine:
    input:
        library=files_of(OTHERS),
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
        variants=lambda wildcards: VARIANTS[wildcards.estimator],
        tabulated=lambda wildcards: study.tabulated(ESTIMATORS[wildcards.estimator]),
        everywhere=lambda wildcards: study.tabulated(
            ESTIMATORS[wildcards.estimator], study.more_readings
        ),
        code=lambda wildcards: code("refine", estimators.path(ESTIMATORS[wildcards.estimator])),
    script:
        "../scripts/refine.py"


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
        variants=lambda wildcards: VARIANTS[wildcards.estimator],
        tabulated=lambda wildcards: study.tabulated(ESTIMATORS[wildcards.estimator]),
        meshes=NOISY,
        code=lambda wildcards: code("trials", estimators.path(ESTIMATORS[wildcards.estimator])),
    script:
        "../scripts/trials.py"


rule best_explanation:
    input:
        library=files_of([*NOISY, *OTHERS]),
        readings=rules.explanations.output.readings,
    output:
        errors=study.results / "best-explanation/errors.csv",
        noise=study.results / "best-explanation/noise.csv",
        rings=study.results / "best-explanation/rings.csv",
    log:
        study.results / "logs/best_explanation.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        meshes=OTHERS,
        noisy=NOISY,
        estimators=ESTIMATORS,
        variants=VARIANTS,
        code=code("best_explanation", *map(estimators.path, study.estimators)),
    script:
        "../scripts/best_explanation.py"


REFINED = expand(study.results / "refined/{estimator}.csv", estimator=ESTIMATORS)
REFINED += [rules.best_explanation.output.errors]
NOISE = expand(study.results / "trials/noise-{estimator}.csv", estimator=ESTIMATORS)
NOISE += [rules.best_explanation.output.noise]
RINGS = expand(study.results / "trials/rings-{estimator}.csv", estimator=ESTIMATORS)
RINGS += [rules.best_explanation.output.rings]
