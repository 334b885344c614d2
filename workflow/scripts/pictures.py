"""Draw the surfaces, the tessellations of one of them, and exact curvature."""

from curvlib.catalogue import surfaces
from curvlib.dataset.library import load_library
from curvlib.figures import pictures
from curvlib.figures.render import renderer
from curvlib.figures.style import save
from curvlib.study.job import logged

with logged(snakemake.log[0]):
    params, output = snakemake.params, snakemake.output
    library, draw = load_library(*snakemake.input.library), renderer()
    modules = surfaces.modules(params.surfaces)
    meshes = dict(library.only(params.all))
    paper = {key: meshes[key] for key in params.paper}
    save(pictures.surface_plate(paper, params.numbers, modules, draw), output.surfaces)
    tessellations = library.only(params.tessellations)
    save(pictures.tessellation_plate(tessellations, modules, draw), output.tessellations)
    for quantity in params.quantities:
        save(pictures.curvature_map(meshes, quantity, modules, draw), output[quantity])
