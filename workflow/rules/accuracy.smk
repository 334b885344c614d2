# In: the errors of every estimator's variants. Out: the tables of errors, slopes and ranks of every
# reading, and what a reading is.


rule accuracy:
    input:
        ERRORS,
    output:
        readings=study.results / "tables/readings.csv",
        errors=study.results / "tables/errors.csv",
        convergence=study.results / "tables/convergence.csv",
        ranks=study.results / "tables/ranks.csv",
    params:
        readings=reading_rows(study.all_readings()),
        full=FULL,
        code=code("accuracy"),
    log:
        study.results / "logs/accuracy.log",
    conda:
        "../envs/curvlib.yaml"
    script:
        "../scripts/accuracy.py"
