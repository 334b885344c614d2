"""Tessellate one surface in every way and write its meshes into the library."""

from curvlib.dataset.write import write_library
from curvlib.study.job import logged
from curvlib.surfaces._named import surface as load

with logged(snakemake.log[0]):
    params = snakemake.params
    write_library(load(params.surface), params.meshes, params.folder)
