# In: nothing. Out: functions of the libraries that are installed, and our estimators, against what a
# user of curvature values relies on: table, matrix and page. Not part of `all`: it depends on what is
# installed.
from curvlib.catalogue import libraries


rule conformance:
    output:
        table=study.results / "benchmark/tables/conformance.csv",
        figures=[study.results / f"benchmark/figures/conformance.{kind}" for kind in ("svg", "png")],
        page=study.results / "benchmark/is-my-library-right.md",
    log:
        study.results / "logs/conformance.log",
    conda:
        "../envs/curvlib.yaml"
    threads: workflow.cores
    params:
        code=lambda _: code("conformance", *map(libraries.path, libraries.names())),
        libraries=installed_libraries,
    script:
        "../scripts/conformance.py"
