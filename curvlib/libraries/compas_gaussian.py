"""COMPAS, with libigl: angle defects."""

LABEL = "compas_libigl.curvature.trimesh_gaussian_curvature"
SOURCE = "https://compas.dev/compas_libigl/"
REQUIRES = "compas_libigl"
DOCUMENTED = {
    "scaling": (
        "Calculates the Gaussian curvature at each vertex of a triangle "
        "mesh using the angle defect method."
    ),
}


def values(vertices, faces):
    """K."""
    from compas_libigl.curvature import trimesh_gaussian_curvature

    return {"K": trimesh_gaussian_curvature((vertices.tolist(), faces.tolist()))}
