"""Staircases: marching cubes over a mask of voxels, at isovalue 1."""

from curvlib.implicit import _sampled

LABEL = "Voxels"
SURFACES = ("ellipsoid", "genus_3", "goursat", "gyroid", "sphere", "torus")


def make(surface, n, seed):
    """n voxels along the longest side of the surface's box. All vertices are centres of voxels
    inside: the mesh lies about half a voxel within the surface."""
    return _sampled.voxels(surface, n, seed)
