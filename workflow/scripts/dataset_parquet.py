"""Pack the meshes of the library into one Parquet file."""

from curvlib.catalogue import surfaces
from curvlib.dataset.description import mesh_table
from curvlib.dataset.library import load_library
from curvlib.dataset.parquet import write_parquet
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    params = snakemake.params
    labels = {name: surfaces.module(file).LABEL for name, file in params.surfaces.items()}
    library = load_library(params.folder).only(params.meshes)
    write_parquet(snakemake.output[0], mesh_table(library, labels), params.folder)
