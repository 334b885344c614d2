# In: a surface's file. Out: its meshes with exact curvature, HDF5, and a text file per mesh.
from curvlib.library import text_name

TEXTS = [text_name(diagonal, n) for diagonal in study.diagonals for n in study.resolutions]
LIBRARY = expand(study.library / "{surface}.h5", surface=SURFACES)


rule library:
    output:
        hdf5=study.library / "{surface}.h5",
        texts=[study.library / "{surface}" / text for text in TEXTS],
    log:
        study.results / "logs/library/{surface}.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        surface=lambda wildcards: SURFACES[wildcards.surface],
        resolutions=study.resolutions,
        diagonals=study.diagonals,
        code=lambda wildcards: code("library", surfaces.path(SURFACES[wildcards.surface])),
    script:
        "../scripts/library.py"
