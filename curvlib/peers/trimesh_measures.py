"""trimesh: curvature measures of a ball."""

import math

import numpy as np

from curvlib.kit.options import Length
from curvlib.peers._turned import over_used, where_closed

LABEL = "trimesh, measures of a ball"
SOURCE = "https://trimesh.org/trimesh.curvature.html"
REQUIRES = "trimesh rtree"
RETURNS = "integrated"
SIGN = "ours"
BOUNDARY = "as closed"
ORDER = None


def returned(vertices, faces, radius):
    """Sums over the ball of `radius` around each vertex: of the angle defects, and of half the
    angle of each edge times the edge's length in the ball."""
    import trimesh

    mesh = trimesh.Trimesh(vertices, faces, process=False)
    return (
        trimesh.curvature.discrete_gaussian_curvature_measure(mesh, vertices, radius),
        trimesh.curvature.discrete_mean_curvature_measure(mesh, vertices, radius),
    )


def estimate(mesh, radius: Length = "3 edges"):
    """K and H as the measures over pi radius^2, the area of a sphere in a ball around one of its
    points; NaN where a vertex whose triangles do not close to one ring lies in the ball."""
    from scipy.spatial import KDTree

    measures = over_used(returned, mesh, radius=radius)
    K, H = where_closed(mesh, *(values / (math.pi * radius**2) for values in measures))
    if not mesh.closed.all():
        distance, _ = KDTree(mesh.vertices[~mesh.closed]).query(mesh.vertices)
        K[distance <= radius] = H[distance <= radius] = np.nan
    return K, H
