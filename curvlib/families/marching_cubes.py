"""Marching cubes over the function of an implicit surface."""

from curvlib.implicit import _sampled

LABEL = "Marching cubes"
SURFACES = ("ellipsoid", "genus_3", "goursat", "gyroid", "sphere", "torus")


def make(surface, n, seed):
    """n cells along the longest side of the surface's box. Vertices lie on the cells' edges, near
    to the surface, by linear interpolation; many triangles are small or thin."""
    return _sampled.marching_cubes(surface, n, seed)
