"""MeshLab: quadrics fitted to one ring."""

import numpy as np

from curvlib.kit.tensor import Curvatures
from curvlib.peers._turned import over_used

LABEL = "MeshLab, quadric"
SOURCE = (
    "https://pymeshlab.readthedocs.io/en/latest/filter_list.html"
    "#compute_curvature_principal_directions_per_vertex"
)
REQUIRES = "pymeshlab"
RETURNS = "pointwise"
SIGN = "ours"
BOUNDARY = "estimated"
ORDER = "swapped"
PRECISION = "single"


def returned(vertices, faces):
    """What it calls maximal and minimal curvature; not the directions, which belong to the other
    one at some vertices of negative K."""
    import pymeshlab

    meshes, values = pymeshlab.MeshSet(), []
    meshes.add_mesh(pymeshlab.Mesh(vertices, faces.astype(np.int32)))
    for kind in ("Max Curvature", "Min Curvature"):
        meshes.compute_curvature_principal_directions_per_vertex(
            method="Quadric Fitting", curvcolormethod=kind, autoclean=False
        )
        values.append(meshes.current_mesh().vertex_scalar_array())
    return *values, None, None


def estimate(mesh):
    """K, H, k1 and k2, from the vertices of one ring."""
    k2, k1, _, _ = over_used(returned, mesh)
    return Curvatures(k1 * k2, (k1 + k2) / 2, k1, k2, None, None)
