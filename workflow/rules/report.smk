# In: all that the study makes. Out: Snakemake's own report of it, with the answer on its start page,
# tables as pages and captions in view; one file that needs no network. Not part of `all`.
REPORT = Path(HOUSE, "workflow/report")


rule table_pages:
    input:
        tables=[study.results / f"tables/{table}.csv" for table in TABLED],
        captions=[caption(f"table-{table}") for table in TABLED],
        answer=rules.claims.output.answer,
        summary=rules.claims.output.summary,
        template=REPORT / "table.html",
    output:
        pages=[
            reported(study.results / f"report/{table}.html", HOLDS, f"table-{table}")
            for table in TABLED
        ],
        answer=study.results / "report/answer.html",
    log:
        study.results / "logs/table_pages.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        names=Named(SURFACE_LABELS | ESTIMATOR_LABELS),
        code=code("table_pages"),
    script:
        "../scripts/table_pages.py"


rule report:
    input:
        rules.all.input,
        rules.table_pages.output,
        sorted(REPORT.iterdir()),
    output:
        study.results / "report.html",
    log:
        study.results / "logs/report.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        snakefile=workflow.main_snakefile,
        config=Named({**config, "results": str(study.results)}),
        style=REPORT / "report.css",
        behaviour=REPORT / "report.js",
        code=code("report"),
    script:
        "../scripts/report.py"
