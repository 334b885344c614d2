# The whole study: `snakemake` alone makes everything that rule `all` names.
# config -> library -> estimates -> explanations -> errors, slopes, ranks -> claims -> figures, article


report: "workflow/report/workflow.rst"


# Where this file lies, also where another workflow uses it as a module.
HOUSE = workflow.current_basedir.get_path_or_uri(secret_free=True)


configfile: f"{HOUSE}/config/config.yaml"


include: "workflow/rules/common.smk"


if not ARCHIVED:

    include: "workflow/rules/library.smk"
    include: "workflow/rules/dataset.smk"


include: "workflow/rules/estimates.smk"
include: "workflow/rules/explanations.smk"
include: "workflow/rules/refined.smk"
include: "workflow/rules/accuracy.smk"
include: "workflow/rules/shapes.smk"
include: "workflow/rules/claims.smk"
include: "workflow/rules/pictures.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/paper.smk"
include: "workflow/rules/readme.smk"
include: "workflow/rules/throughput.smk"
include: "workflow/rules/estimators.smk"
include: "workflow/rules/adaptive.smk"
include: "workflow/rules/coverage.smk"
include: "workflow/rules/frontier.smk"
include: "workflow/rules/benchmark.smk"
include: "workflow/rules/conformance.smk"


rule all:
    default_target: True
    input:
        LIBRARY,
        rules.accuracy.output,
        rules.shapes.output,
        rules.claims.output,
        rules.figures.input,
        rules.paper.output if THE_STUDY else [],


include: "workflow/rules/report.smk"


onsuccess:
    made = {
        "article": study.results / "paper/paper.pdf",
        "tables": study.results / "tables",
        "figures": FIGURES,
        "report": study.results / "report.html",
    }
    for name, path in made.items():
        if path.exists():
            print(f"{name:8} {path}", file=sys.stderr)
    if not made["report"].exists():
        print("report   made by `snakemake report`", file=sys.stderr)
