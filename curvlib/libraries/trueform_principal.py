"""trueform: fits over two rings."""

LABEL = "trueform.principal_curvatures"
SOURCE = "https://pypi.org/project/trueform/"
REQUIRES = "trueform"
INSTALL = "not under a free licence: pip install trueform, where its terms allow"
DOCUMENTED = {
    "order of k1 and k2": "k0 is the maximum curvature, k1 is the minimum curvature.",
}


def values(vertices, faces):
    """k1 and k2, with trueform's default of two rings."""
    import numpy as np
    import trueform

    k1, k2 = trueform.principal_curvatures((faces.astype(np.int32), vertices))
    return {"k1": k1, "k2": k2}
