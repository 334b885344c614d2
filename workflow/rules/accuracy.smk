# In: the errors of every estimator's variants, and of its trials; what a reading is. Out: the tables:
# errors and their curves by variant; errors, slopes and ranks of every reading; noise, and slopes on
# shrinking rings.


rule accuracy:
    input:
        errors=[*ERRORS, *REFINED],
        readings=rules.explanations.output.readings,
        noise=NOISE,
        rings=RINGS,
    output:
        **{
            name: study.results / f"tables/{name}.csv"
            for name in ("variants", "curves", "errors", "convergence", "ranks", "noise", "rings")
        },
    log:
        study.results / "logs/accuracy.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        full=FULL,
        paper=PAPER,
        code=code("accuracy"),
    script:
        "../scripts/accuracy.py"
