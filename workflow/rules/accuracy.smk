# In: the meshes and all estimates. Out: the tables of errors, slopes and ranks, and the answer.


rule accuracy:
    input:
        library=LIBRARY,
        estimates=ESTIMATES,
    output:
        errors=study.results / "tables/errors.csv",
        convergence=study.results / "tables/convergence.csv",
        ranks=study.results / "tables/ranks.csv",
        answer=study.results / "tables/answer.md",
    log:
        study.results / "logs/accuracy.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        meshes=MESHES,
        variants={
            name: {
                reading: variant(study.options(ESTIMATORS[name], reading))
                for reading in study.readings
            }
            for name in ESTIMATORS
        },
        code=code("accuracy"),
    script:
        "../scripts/accuracy.py"
