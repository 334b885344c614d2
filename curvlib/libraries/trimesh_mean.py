"""trimesh: mean curvature measure of a ball."""

LABEL = "trimesh.curvature.discrete_mean_curvature_measure"
SOURCE = "https://trimesh.org/trimesh.curvature.html"
REQUIRES = "trimesh rtree"
DOCUMENTED = {
    "scaling": ("the sum of the angle at all edges contained in the sphere for each point"),
}
REMEDIES = {
    "scaling": "divide by pi radius^2, about the area of the surface in the ball",
}


def values(vertices, faces):
    """H of the ball of three mean edges around each vertex."""
    import numpy as np
    import trimesh

    mesh = trimesh.Trimesh(vertices, faces, process=False)
    radius = 3 * np.mean(mesh.edges_unique_length)
    measure = trimesh.curvature.discrete_mean_curvature_measure
    return {"H": measure(mesh, vertices, radius)}
