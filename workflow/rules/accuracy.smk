# In: the errors of every estimator's variants. Out: the tables of errors, slopes and ranks of every
# reading, and what a reading is.


rule accuracy:
    input:
        ERRORS,
    output:
        readings=tabled("readings"),
        errors=study.results / "tables/errors.csv",
        convergence=study.results / "tables/convergence.csv",
        ranks=study.results / "tables/ranks.csv",
    log:
        study.results / "logs/accuracy.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        readings=study.rows(study.all_readings()),
        full=FULL,
        code=code("accuracy"),
    script:
        "../scripts/accuracy.py"
