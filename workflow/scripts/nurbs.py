"""Write the NURBS surfaces of the library."""

from curvlib.dataset.write import write_nurbs
from curvlib.study.job import logged
from curvlib.surfaces._named import surface as load

with logged(snakemake.log[0]):
    for surface in snakemake.params.surfaces:
        write_nurbs(load(surface), snakemake.params.folder)
