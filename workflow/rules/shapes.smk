# In: what a reading is. Out: the errors of the estimators on random shapes, in the default reading and
# in the one that explains the paper best.


rule shapes:
    input:
        readings=rules.explanations.output.readings,
    output:
        shapes=study.results / "tables/shapes.csv",
    log:
        study.results / "logs/shapes.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        estimators=ESTIMATORS,
        variants=VARIANTS,
        # The paper's finest mesh.
        diagonal=study.diagonals[0],
        n=study.resolutions[-1],
        code=code("shapes", *map(estimators.path, study.estimators)),
    script:
        "../scripts/shapes.py"
