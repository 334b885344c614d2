"""MeshLab: quadrics fitted to one ring."""

LABEL = "pymeshlab compute_curvature_principal_directions_per_vertex"
SOURCE = "https://pymeshlab.readthedocs.io/en/latest/filter_list.html#compute_curvature_principal_directions_per_vertex"
REQUIRES = "pymeshlab"


def values(vertices, faces):
    """k1 and k2."""
    import numpy as np
    import pymeshlab

    meshes, found = pymeshlab.MeshSet(), {}
    meshes.add_mesh(pymeshlab.Mesh(vertices, faces.astype(np.int32)))
    meshes.compute_curvature_principal_directions_per_vertex(
        method="Quadric Fitting", curvcolormethod="Max Curvature", autoclean=False
    )
    found["k1"] = meshes.current_mesh().vertex_scalar_array()
    meshes.compute_curvature_principal_directions_per_vertex(
        method="Quadric Fitting", curvcolormethod="Min Curvature", autoclean=False
    )
    found["k2"] = meshes.current_mesh().vertex_scalar_array()
    return found
