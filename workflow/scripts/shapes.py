"""Errors of the study's estimators on random shapes, in the readings that matter."""

import pandas as pd

from curvlib.claims.guesses import readings_on_shapes
from curvlib.comparison.run import write_rows
from curvlib.comparison.shapes import COLUMNS, shape_rows
from curvlib.nurbs.tessellation import tessellate
from curvlib.study.job import logged
from curvlib.surfaces._random import random_shapes

with logged(snakemake.log[0]):
    params = snakemake.params
    cut = {"diagonal": params.diagonal, "n": params.n}
    meshes = (
        (
            {"family": family, "shape": number, "proportions": proportions}
            | {"surface": surface.name, **cut},
            tessellate(surface, params.n, params.diagonal),
        )
        for family, number, proportions, surface in random_shapes()
    )
    readings = readings_on_shapes(pd.read_csv(snakemake.input.readings))
    rows = shape_rows(meshes, readings, params.estimators, params.variants)
    write_rows(snakemake.output.shapes, COLUMNS, rows)
