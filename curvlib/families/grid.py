"""The grids of the study of 2003: NURBS surfaces cut along lines of their parameters."""

from curvlib.nurbs.tessellation import tessellate
from curvlib.surfaces._named import surface as named

LABEL = "Grids of 2003"
SURFACES = ("revolution", "sphere", "teapot_body", "teapot_spout")


def make(surface, n, seed):
    """n x n cells, each cut along the same diagonal; nothing is random."""
    return tessellate(named(surface), n)
