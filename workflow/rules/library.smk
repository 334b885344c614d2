# In: a surface's file. Out: its meshes with exact curvature, HDF5, and a text file per mesh.
from curvlib.library import text_name

MESHES = [(diagonal, n) for diagonal, n, _ in study.meshes()]
FULL = [(diagonal, n) for diagonal, n, full in study.meshes() if full]
LIBRARY = expand(study.library / "{surface}.h5", surface=SURFACES)


rule library:
    output:
        hdf5=study.library / "{surface}.h5",
        texts=[study.library / "{surface}" / text_name(*mesh) for mesh in MESHES],
    log:
        study.results / "logs/library/{surface}.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        surface=lambda wildcards: SURFACES[wildcards.surface],
        meshes=MESHES,
        code=lambda wildcards: code("library", surfaces.path(SURFACES[wildcards.surface])),
    script:
        "../scripts/library.py"
