"""gpytoolbox: angle defects."""

from curvlib.peers._turned import of_defects

LABEL = "gpytoolbox, angle defect"
SOURCE = "https://gpytoolbox.org/0.3.0/angle_defect/"
REQUIRES = "gpytoolbox"
RETURNS = "integrated"
SIGN = None
BOUNDARY = "zero"
ORDER = None


def returned(vertices, faces):
    """The defects, 2 pi minus the sum of the angles; no H."""
    import gpytoolbox

    return gpytoolbox.angle_defect(vertices, faces), None


def estimate(mesh):
    """K as the defect over the barycentric cell; NaN where the triangles close to no ring."""
    return of_defects(returned, mesh)
