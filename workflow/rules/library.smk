# In: a surface's file. Out: its meshes with exact curvature, each as VTKHDF, PLY and text.
from curvlib.library import mesh_files

GRID = list(product(study.diagonals, study.resolutions))
# For the archive alone, on the first diagonal.
FURTHER_GRID = [
    (study.diagonals[0], n) for n in study.dataset_resolutions if n not in study.resolutions
]
LIBRARY = [study.library / mesh_files(*mesh)[0] for mesh in MESHES]


rule library:
    output:
        [study.library / file for mesh in GRID for file in mesh_files("{surface}", *mesh)],
    log:
        study.results / "logs/library/{surface}.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        surface=lambda wildcards: SURFACES[wildcards.surface],
        meshes=GRID,
        folder=study.library,
        code=lambda wildcards: code("library", surfaces.path(SURFACES[wildcards.surface])),
    script:
        "../scripts/library.py"


if FURTHER_GRID:

    use rule library as further_library with:
        output:
            [
                study.library / file
                for mesh in FURTHER_GRID
                for file in mesh_files("{surface}", *mesh)
            ],
        log:
            study.results / "logs/further_library/{surface}.log",
        params:
            meshes=FURTHER_GRID,
