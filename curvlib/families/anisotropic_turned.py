"""Triangles ten times as long as wide, at about 45 degrees from the principal directions."""

from curvlib.families._stretched import stretched

LABEL = "Anisotropic 1:10, turned"
SURFACES = ("patch", "torus")


def make(surface, n, seed):
    """About n^2 vertices; on the torus the long sides follow a helix."""
    return stretched(surface, n, seed, 1)
