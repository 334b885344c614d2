# In: the meshes of the study, the surfaces, templates of their description.
# Out: one archive of all of these, and its hash. Not part of `all`.
from curvlib import __version__
from curvlib.dataset.library import nurbs_file

TEMPLATES = [
    f"{HOUSE}/workflow/archive/{name}"
    for name in ("README.md", "CITATION.cff", "croissant.json", "datapackage.json")
]


rule nurbs:
    output:
        [study.library / nurbs_file(surface) for surface in SURFACES],
    log:
        study.results / "logs/nurbs.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        surfaces=study.surfaces,
        folder=study.library,
        code=code("nurbs", *map(surfaces.path, study.surfaces)),
    script:
        "../scripts/nurbs.py"


rule dataset:
    input:
        files=[study.library / file for mesh in sorted(MESHES) for file in mesh_files(*mesh)],
        nurbs=rules.nurbs.output,
        templates=TEMPLATES,
        licence=f"{HOUSE}/LICENSE-data",
        citation=f"{HOUSE}/CITATION.cff",
        versions=f"{HOUSE}/requirements.lock",
    output:
        archive=study.results / f"dataset/curvature-library-{__version__}.zip",
        sums=study.results / "dataset/SHA256SUMS",
    log:
        study.results / "logs/dataset.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        meshes=sorted(MESHES),
        surfaces=SURFACES,
        folder=study.library,
        version=__version__,
        code=code("dataset"),
    script:
        "../scripts/dataset.py"


rule dataset_parquet:
    input:
        [study.library / file for mesh in sorted(MESHES) for file in mesh_files(*mesh)],
    output:
        study.results / f"dataset/curvature-library-{__version__}.parquet",
    log:
        study.results / "logs/dataset_parquet.log",
    conda:
        "../envs/curvlib.yaml"
    params:
        meshes=sorted(MESHES),
        surfaces=SURFACES,
        folder=study.library,
        code=code("dataset_parquet"),
    script:
        "../scripts/dataset_parquet.py"
