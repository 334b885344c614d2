# In: the errors of every estimator's variants, and of its trials. Out: the tables: what a reading is,
# errors and their curves by variant; errors, slopes and ranks of every reading; noise, and slopes on
# shrinking rings.
READINGS = study.all_readings() | study.products()
KINDS = (
    dict.fromkeys(study.products(), "product")
    | dict.fromkeys(study.single_changes(), "single")
    | dict.fromkeys(study.readings, "named")
)


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
        readings=reading_rows(READINGS),
        kinds=KINDS,
        full=FULL,
        code=code("accuracy"),
    script:
        "../scripts/accuracy.py"
