"""Tessellate one surface at all resolutions and write its part of the library."""

from curvlib.job import logged
from curvlib.library import write_library
from curvlib.surfaces import load

with logged(snakemake.log[0]):
    write_library(
        load(snakemake.params.surface),
        snakemake.params.resolutions,
        snakemake.params.diagonals,
        snakemake.output.hdf5,
    )
