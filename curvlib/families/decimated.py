"""Fine meshes thinned out by quadric error, their vertices brought back to the surface."""

import numpy as np

from curvlib.catalogue import families
from curvlib.families._charts import used
from curvlib.implicit._exact import on_surface
from curvlib.implicit._sampled import marching_cubes

LABEL = "Decimated"
SURFACES = ("ellipsoid", "genus_3", "goursat", "torus")
KEPT = 0.2  # of the triangles


def make(surface, n, seed):
    """About n^2 vertices: a fifth of those of a jittered mesh, or of one by marching cubes.

    Decimation keeps more vertices where the surface bends more.
    """
    import pyvista

    if surface == "genus_3":
        fine = marching_cubes(surface, round(n / np.sqrt(5.8 * KEPT)), seed)
    else:
        fine = families.module("jittered").make(surface, round(n / np.sqrt(KEPT)), seed)
    data = pyvista.PolyData.from_regular_faces(fine.vertices, fine.faces)
    thin = data.decimate(1 - KEPT)
    vertices, faces = used(np.asarray(thin.points, float), thin.faces.reshape(-1, 4)[:, 1:])
    return on_surface(surface, vertices, faces)
