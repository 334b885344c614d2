"""MeshLab: discrete Gaussian curvature."""

LABEL = "pymeshlab compute_scalar_by_discrete_curvature_per_vertex('Gaussian')"
SOURCE = "https://pymeshlab.readthedocs.io/en/latest/filter_list.html#compute_scalar_by_discrete_curvature_per_vertex"
REQUIRES = "pymeshlab"


def values(vertices, faces):
    """K."""
    import numpy as np
    import pymeshlab

    meshes, found = pymeshlab.MeshSet(), {}
    meshes.add_mesh(pymeshlab.Mesh(vertices, faces.astype(np.int32)))
    meshes.compute_scalar_by_discrete_curvature_per_vertex(curvaturetype="Gaussian Curvature")
    found["K"] = meshes.current_mesh().vertex_scalar_array()
    return found
