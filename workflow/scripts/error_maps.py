"""Draw where each estimator errs on one mesh."""

from curvlib.catalogue import estimators, surfaces
from curvlib.comparison.run import read_values
from curvlib.dataset.library import load_library
from curvlib.figures import pictures
from curvlib.figures.render import renderer
from curvlib.figures.style import save
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    inputs, params = snakemake.input, snakemake.params
    key, draw = params.mesh, renderer()
    mesh = load_library(*inputs.library).only([key])[key]
    values = {name: read_values(f, [key])[key] for name, f in zip(params.estimators, inputs.values)}
    modules = estimators.modules(params.estimators)
    surface = surfaces.module(params.surface)
    for quantity in params.quantities:
        drawn = pictures.error_map(mesh, values, quantity, surface, modules, draw)
        save(drawn, snakemake.output[quantity])
