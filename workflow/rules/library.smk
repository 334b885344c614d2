# In: the file of a surface. Out: its meshes with exact curvature, each as VTKHDF, PLY and text.


rule library:
    output:
        [study.library / file for mesh in CUTS for file in mesh_files("{surface}", *mesh)],
    log:
        study.results / "logs/library/{surface}.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        surface=lambda wildcards: SURFACES[wildcards.surface],
        meshes=CUTS,
        folder=study.library,
        code=lambda wildcards: code("library", surfaces.path(SURFACES[wildcards.surface])),
    script:
        "../scripts/library.py"
