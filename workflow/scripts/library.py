"""Tessellate one surface in all ways and write its part of the library."""

from curvlib.job import logged
from curvlib.library import write_library
from curvlib.surfaces import load

with logged(snakemake.log[0]):
    surface = load(snakemake.params.surface)
    write_library(surface, snakemake.params.meshes, snakemake.output.hdf5)
