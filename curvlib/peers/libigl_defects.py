"""libigl: angle defects."""

from curvlib.peers._turned import of_defects

LABEL = "libigl, angle defect"
SOURCE = "https://libigl.github.io/dox/gaussian__curvature_8h.html"
REQUIRES = "libigl"
RETURNS = "integrated"
SIGN = None
BOUNDARY = "as closed"
ORDER = None


def returned(vertices, faces):
    """The defects, 2 pi minus the sum of the angles; no H."""
    import igl

    return igl.gaussian_curvature(vertices, faces), None


def estimate(mesh):
    """K as the defect over the barycentric cell; NaN where the triangles close to no ring."""
    return of_defects(returned, mesh)
