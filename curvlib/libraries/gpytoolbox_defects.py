"""gpytoolbox: angle defects."""

LABEL = "gpytoolbox.angle_defect"
SOURCE = "https://gpytoolbox.org/latest/angle_defect/"
REQUIRES = "gpytoolbox"
DOCUMENTED = {
    "scaling": "The angle defect is a proxy for integrated Gaussian curvature.",
    "boundary": "except at boundary vertices, where it is `0`",
}


def values(vertices, faces):
    """K."""
    import gpytoolbox

    return {"K": gpytoolbox.angle_defect(vertices, faces)}
