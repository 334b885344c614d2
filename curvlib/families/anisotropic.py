"""Triangles ten times as long as wide, along the principal directions."""

from curvlib.families._stretched import stretched

LABEL = "Anisotropic 1:10"
SURFACES = ("patch", "torus")


def make(surface, n, seed):
    """About n^2 vertices, long along x on the patch and along the circles about the axis on the
    torus, where it bends less."""
    return stretched(surface, n, seed, 0)
