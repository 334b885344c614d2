"""libigl: quadrics fitted over five rings."""

LABEL = "igl.principal_curvature"
SOURCE = "https://libigl.github.io/dox/principal__curvature_8h.html"
REQUIRES = "libigl"
DOCUMENTED = {
    "order of k1 and k2": "PV1: vector of maximal curvature values for each vertex",
}
REMEDIES = {
    "renumbering": (
        "average over several orders of the vertices, or bring them into one order first"
    ),
}


def values(vertices, faces):
    """k1 and k2, with libigl's default of five rings."""
    import igl

    _, _, k1, k2, _ = igl.principal_curvature(vertices, faces)
    return {"k1": k1, "k2": k2}
