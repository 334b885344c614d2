# In: the errors of every estimator's variants, and of its trials. Out: the tables: what a reading is,
# errors and their curves by variant; errors, slopes and ranks of every reading; noise, and slopes on
# shrinking rings.


rule accuracy:
    input:
        errors=ERRORS,
        noise=NOISE,
        rings=RINGS,
    output:
        **{
            name: study.results / f"tables/{name}.csv"
            for name in ("variants", "curves", "errors", "convergence", "ranks", "noise", "rings")
        },
        readings=tabled("readings"),
    log:
        study.results / "logs/accuracy.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        readings=study.rows(),
        full=FULL,
        code=code("accuracy"),
    script:
        "../scripts/accuracy.py"
