"""Draw where each estimator errs on one mesh."""

from curvlib import pictures
from curvlib.catalogue import estimators, surfaces
from curvlib.figures import save
from curvlib.job import logged
from curvlib.library import load_library
from curvlib.render import renderer
from curvlib.results import read_values

with logged(snakemake.log[0]):
    inputs, params = snakemake.input, snakemake.params
    key, draw = params.mesh, renderer()
    mesh = load_library(*inputs.library).only([key])[key]
    values = {name: read_values(f, [key])[key] for name, f in zip(params.estimators, inputs.values)}
    modules = estimators.modules(params.estimators)
    surface = surfaces.module(params.surface)
    for quantity in "KH":
        drawn = pictures.error_map(mesh, values, quantity, surface, modules, draw)
        save(drawn, snakemake.output[quantity])
