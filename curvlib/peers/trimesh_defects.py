"""trimesh: angle defects."""

from curvlib.peers._turned import of_defects

LABEL = "trimesh, angle defect"
SOURCE = "https://trimesh.org/trimesh.curvature.html#trimesh.curvature.vertex_defects"
REQUIRES = "trimesh"
RETURNS = "integrated"
SIGN = None
BOUNDARY = "as closed"
ORDER = None


def returned(vertices, faces):
    """The defects, 2 pi minus the sum of the angles; no H."""
    import trimesh

    return trimesh.Trimesh(vertices, faces, process=False).vertex_defects, None


def estimate(mesh):
    """K as the defect over the barycentric cell; NaN where the triangles close to no ring."""
    return of_defects(returned, mesh)
