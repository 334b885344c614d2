"""trimesh: Gaussian curvature measure of a ball."""

LABEL = "trimesh.curvature.discrete_gaussian_curvature_measure"
SOURCE = "https://trimesh.org/trimesh.curvature.html"
REQUIRES = "trimesh"
DOCUMENTED = {
    "scaling": ("the sum of the vertex defects at all vertices within the radius for each point"),
}
REMEDIES = {
    "scaling": "divide by pi radius^2, about the area of the surface in the ball",
}


def values(vertices, faces):
    """K of the ball of three mean edges around each vertex."""
    import numpy as np
    import trimesh

    mesh = trimesh.Trimesh(vertices, faces, process=False)
    radius = 3 * np.mean(mesh.edges_unique_length)
    measure = trimesh.curvature.discrete_gaussian_curvature_measure
    return {"K": measure(mesh, vertices, radius)}
