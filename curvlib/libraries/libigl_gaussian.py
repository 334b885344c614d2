"""libigl: angle defects."""

LABEL = "igl.gaussian_curvature"
SOURCE = "https://libigl.github.io/dox/gaussian__curvature_8h.html"
REQUIRES = "libigl"
DOCUMENTED = {
    "scaling": "Compute the 2π minus the sum of interior angles at each vertex.",
}


def values(vertices, faces):
    """K, with libigl's defaults."""
    import igl

    return {"K": igl.gaussian_curvature(vertices, faces)}
