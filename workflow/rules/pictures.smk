# In: the meshes; the estimates. Out: the surfaces and the tessellations of one, the paper's
# Figures 1 and 2; exact curvature on all surfaces; the errors of the estimates on one.
from curvlib.claims.cell import SEVEN, chosen

# The paper's surfaces first, in its order; the one that it looks at closely, else the first.
IN_ORDER = list(dict.fromkeys([*chosen(SURFACES), *SURFACES]))
LOOKED_AT = "teapot_spout" if "teapot_spout" in SURFACES else IN_ORDER[0]
GRID = study.diagonals[0]

# Pictures have other bytes by another renderer.
RENDERER = os.environ.get("CURVLIB_RENDERER", "")

# Round enough to the eye.
ROUND = min((n for diagonal, n in CUTS if diagonal == GRID), key=lambda n: abs(n - 64))
SEEN = Rows(MeshKey(s, GRID, ROUND) for s in IN_ORDER)
TESSELLATIONS = Rows(MeshKey(LOOKED_AT, GRID, n) for n in study.resolutions)

PICTURES = [
    "figure-1",
    "figure-2",
    *(f"{what}-{q}" for what in ("curvature", "error-map") for q in PAPER_FIGURES),
]


rule pictures:
    input:
        library=files_of(dict.fromkeys([*SEEN, *TESSELLATIONS])),
    output:
        **{
            q: reported(FIGURES / f"curvature-{q}.png", MEASURED_ON, f"curvature-{q}")
            for q in PAPER_FIGURES
        },
        surfaces=reported(FIGURES / "figure-1.png", MEASURED_ON, "figure-1"),
        tessellations=reported(FIGURES / "figure-2.png", MEASURED_ON, "figure-2"),
    log:
        study.results / "logs/pictures.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        renderer=RENDERER,
        quantities=list(PAPER_FIGURES),
        surfaces=SURFACES,
        numbers=Named({s: number for number, s in enumerate(dict.fromkeys([*SEVEN, *IN_ORDER]), 1)}),
        paper=Rows(SEEN[: len(chosen(SURFACES))]),
        all=SEEN,
        tessellations=TESSELLATIONS,
        code=code("pictures", *map(surfaces.path, study.surfaces)),
    script:
        "../scripts/pictures.py"


rule error_maps:
    input:
        library=files_of(TESSELLATIONS[-1:]),
        values=expand(study.results / "estimates/{estimator}.h5", estimator=ESTIMATORS),
    output:
        **{
            q: reported(FIGURES / f"error-map-{q}.png", WHERE, f"error-map-{q}")
            for q in PAPER_FIGURES
        },
    log:
        study.results / "logs/error_maps.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        renderer=RENDERER,
        quantities=list(PAPER_FIGURES),
        mesh=TESSELLATIONS[-1],
        surface=SURFACES[LOOKED_AT],
        estimators=ESTIMATORS,
        code=code(
            "error_maps",
            surfaces.path(SURFACES[LOOKED_AT]),
            *map(estimators.path, study.estimators),
        ),
    script:
        "../scripts/error_maps.py"
