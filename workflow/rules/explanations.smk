# In: the errors on the paper's meshes in every joint reading. Out: on how many surfaces each makes each
# claim true; summed up by option; what a reading is, with the best explanation, found here, among them.


rule explanations:
    input:
        errors=ERRORS,
    output:
        explanations=tabled("explanations"),
        alternatives=tabled("alternatives"),
        marginals=tabled("marginals"),
        readings=tabled("readings"),
    log:
        study.results / "logs/explanations.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        readings=study.rows(),
        paper=PAPER,
        code=code("explanations"),
    script:
        "../scripts/explanations.py"
