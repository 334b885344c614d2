# In: config/benchmark.yaml, or the file that the study's config names. Out: every estimator, and what is
# installed of other libraries, on all families of meshes and under noise: results/benchmark/tables, figures,
# the recommendation and the page "Which estimator should I use?". Not part of `all`: the study is about the
# nine of 2003.
from curvlib.benchmark.methods import versions
from curvlib.benchmark.plan import Plan
from curvlib.catalogue import families, implicit, peers

BENCHMARK = study.results / "benchmark"

try:
    PLAN = Plan(Path(HOUSE, study.benchmark))
except InputError as error:
    sys.exit(f"error: {error}")

RANKED = [*map(estimators.path, PLAN.estimators), *map(peers.path, PLAN.peers)]
MESHED = [*map(families.path, PLAN.families), *map(implicit.path, implicit.names())]
# Of the families those whose errors are drawn against n.
DRAWN = ("jittered", "random", "marching_cubes", "voxels")
VOTED = {"adaptive_fit", "ball_regression", "tensor_voting"} & set(estimators.names())
VOTED = [*map(estimators.path, sorted(VOTED)), peers.path("vtk_curvatures")]


tables = partial(tables_in, BENCHMARK)


rule benchmark_errors:
    input:
        PLAN.path,
    output:
        errors=BENCHMARK / "errors/{part}.csv",
        causes=BENCHMARK / "causes/{part}.csv",
    log:
        BENCHMARK / "logs/errors/{part}.log",
    wildcard_constraints:
        part="|".join(map(re.escape, PLAN.parts)),
    conda:
        "../envs/curvlib.yaml"
    params:
        code=code("benchmark_errors", *RANKED, *MESHED),
        # A library that is installed or updated joins.
        libraries=lambda _: versions(PLAN),
    script:
        "../scripts/benchmark_errors.py"


rule benchmark_cost:
    input:
        PLAN.path,
    output:
        **tables("cost"),
    log:
        BENCHMARK / "logs/cost.log",
    conda:
        "../envs/curvlib.yaml"
    # Alone on the machine: what runs beside it takes cache and bandwidth.
    threads: workflow.cores
    params:
        code=code("benchmark_cost", *RANKED),
        libraries=lambda _: versions(PLAN),
    script:
        "../scripts/benchmark_cost.py"


rule benchmark_tables:
    input:
        plan=PLAN.path,
        errors=expand(BENCHMARK / "errors/{part}.csv", part=PLAN.parts),
        causes=expand(BENCHMARK / "causes/{part}.csv", part=PLAN.parts),
        cost=rules.benchmark_cost.output.cost,
    output:
        **tables("errors", "undefined", "orders", "ranking", "situations", "advice", "methods"),
    log:
        BENCHMARK / "logs/tables.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        code=code("benchmark_tables"),
        libraries=lambda _: versions(PLAN),
    script:
        "../scripts/benchmark_tables.py"


rule benchmark_pages:
    input:
        plan=PLAN.path,
        advice=rules.benchmark_tables.output.advice,
        situations=rules.benchmark_tables.output.situations,
        methods=rules.benchmark_tables.output.methods,
        cost=rules.benchmark_cost.output.cost,
    output:
        recommendation=BENCHMARK / "tables/recommendation.md",
        which=BENCHMARK / "which-estimator.md",
    log:
        BENCHMARK / "logs/pages.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        code=code("benchmark_pages"),
    script:
        "../scripts/benchmark_pages.py"


rule benchmark_plots:
    input:
        errors=rules.benchmark_tables.output.errors,
        situations=rules.benchmark_tables.output.situations,
        cost=rules.benchmark_cost.output.cost,
    output:
        matrix=files_in(BENCHMARK / "figures", "ranks", "svg", "png"),
        cost_K=files_in(BENCHMARK / "figures", "error-against-cost-K", "svg", "png"),
        cost_H=files_in(BENCHMARK / "figures", "error-against-cost-H", "svg", "png"),
        noise=files_in(BENCHMARK / "figures", "noise", "svg", "png"),
        order=files_in(BENCHMARK / "figures", "order", "svg", "png"),
    log:
        BENCHMARK / "logs/plots.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        # As many as stand side by side.
        kinds=PLAN.noise["kinds"][:3],
        families=[name for name in DRAWN if name in PLAN.families],
        code=code("benchmark_plots", *MESHED),
    script:
        "../scripts/benchmark_plots.py"


rule claims_2020:
    input:
        PLAN.path,
    output:
        **tables("claims-2020", "claims-2020-sentences"),
    log:
        BENCHMARK / "logs/claims_2020.log",
    # The longest job: votes over half a sphere of 18,384 triangles. It starts first.
    priority: 1
    conda:
        "../envs/curvlib.yaml"
    params:
        code=code("claims_2020", *VOTED),
    script:
        "../scripts/claims_2020.py"


rule benchmark:
    input:
        rules.benchmark_plots.output,
        rules.claims_2020.output,
        rules.benchmark_tables.output,
        rules.benchmark_pages.output,
