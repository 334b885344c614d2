# In: all that the study makes. Out: Snakemake's own report of it, one file that needs no network.
# Not part of `all`.


rule report:
    input:
        rules.all.input,
    output:
        study.results / "report.html",
    log:
        study.results / "logs/report.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        snakefile=workflow.main_snakefile,
        config=config,
    script:
        "../scripts/report.py"
