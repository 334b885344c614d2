"""MeshLib: discrete mean curvature."""

LABEL = "meshlib.mrmeshnumpy.getNumpyMeanCurvature"
SOURCE = "https://meshlib.io/documentation/"
REQUIRES = "meshlib"
INSTALL = "not under a free licence: pip install meshlib, where its terms allow"
DOCUMENTED = {
    "scaling": ("computes discrete mean curvature in given vertex, measures in length^-1"),
    "sign": ("0 for planar regions, positive for convex surface, negative for concave surface"),
}


def values(vertices, faces):
    """H."""
    import numpy as np
    from meshlib import mrmeshnumpy

    mesh = mrmeshnumpy.meshFromFacesVerts(faces.astype(np.int32), vertices)
    return {"H": mrmeshnumpy.getNumpyMeanCurvature(mesh)}
