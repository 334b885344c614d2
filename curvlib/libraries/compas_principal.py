"""COMPAS, with libigl: quadrics fitted over rings."""

LABEL = "compas_libigl.curvature.trimesh_principal_curvature"
SOURCE = "https://compas.dev/compas_libigl/"
REQUIRES = "compas_libigl"
DOCUMENTED = {
    "order of k1 and k2": "PV1: Principal curvature value 1 per vertex (maximum curvature)",
}
REMEDIES = {
    "renumbering": (
        "average over several orders of the vertices, or bring them into one order first"
    ),
}


def values(vertices, faces):
    """k1 and k2."""
    from compas_libigl.curvature import trimesh_principal_curvature

    _, _, k1, k2 = trimesh_principal_curvature((vertices.tolist(), faces.tolist()))
    return {"k1": k1, "k2": k2}
