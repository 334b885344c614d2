"""trimesh: angle defects."""

LABEL = "trimesh.curvature.vertex_defects"
SOURCE = "https://trimesh.org/trimesh.curvature.html"
REQUIRES = "trimesh"
DOCUMENTED = {
    "scaling": ("(2*pi) minus the sum of the angles of every face that includes that vertex"),
}


def values(vertices, faces):
    """K."""
    import trimesh

    mesh = trimesh.Trimesh(vertices, faces, process=False)
    return {"K": trimesh.curvature.vertex_defects(mesh)}
