"""MeshLab: angle defects and cotangents over mixed areas."""

import numpy as np

from curvlib.peers._turned import over_used, where_closed

LABEL = "MeshLab, discrete"
SOURCE = (
    "https://pymeshlab.readthedocs.io/en/latest/filter_list.html"
    "#compute_scalar_by_discrete_curvature_per_vertex"
)
REQUIRES = "pymeshlab"
RETURNS = "pointwise"
SIGN = "ours"
BOUNDARY = "as closed"
ORDER = None
PRECISION = "single"


def returned(vertices, faces):
    """K and H of its discrete curvature."""
    import pymeshlab

    meshes, values = pymeshlab.MeshSet(), []
    meshes.add_mesh(pymeshlab.Mesh(vertices, faces.astype(np.int32)))
    for kind in ("Gaussian Curvature", "Mean Curvature"):
        meshes.compute_scalar_by_discrete_curvature_per_vertex(curvaturetype=kind)
        values.append(meshes.current_mesh().vertex_scalar_array())
    return values


def estimate(mesh):
    """K and H; NaN where the triangles do not close to one ring."""
    return where_closed(mesh, *over_used(returned, mesh))
