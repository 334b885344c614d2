"""MeshLib: angle defects."""

LABEL = "meshlib.mrmeshnumpy.getNumpyGaussianCurvature"
SOURCE = "https://meshlib.io/documentation/"
REQUIRES = "meshlib"
INSTALL = "not under a free licence: pip install meshlib, where its terms allow"
DOCUMENTED = {
    "scaling": ("computes discrete Gaussian curvature (or angle defect) at given vertex"),
}


def values(vertices, faces):
    """K."""
    import numpy as np
    from meshlib import mrmeshnumpy

    mesh = mrmeshnumpy.meshFromFacesVerts(faces.astype(np.int32), vertices)
    return {"K": mrmeshnumpy.getNumpyGaussianCurvature(mesh)}
