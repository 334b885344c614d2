"""Tessellate one surface in all ways and write its part of the library."""

from curvlib.dataset.library import write_library
from curvlib.study.job import logged
from curvlib.surfaces import load

with logged(snakemake.log[0]):
    params = snakemake.params
    write_library(load(params.surface), params.meshes, params.folder)
