"""vedo, with VTK: mean curvature."""

LABEL = "vedo.Mesh.compute_curvature(method=1)"
SOURCE = "https://vedo.embl.es/docs/vedo/mesh.html"
REQUIRES = "vedo"


def values(vertices, faces):
    """H."""
    import vedo

    mesh = vedo.Mesh([vertices, faces]).compute_curvature(method=1)
    return {"H": mesh.pointdata["Mean_Curvature"]}
