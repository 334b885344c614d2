"""libigl: quadrics fitted over some rings."""

from typing import Literal

from curvlib.peers._turned import over_used, six

LABEL = "libigl, quadric"
SOURCE = "https://libigl.github.io/dox/principal__curvature_8h.html"
REQUIRES = "libigl"
RETURNS = "pointwise"
SIGN = "ours"
BOUNDARY = "estimated"
ORDER = "as named"
# Its form is symmetrised in a frame that begins at the first neighbour.
DEPENDS = "labels"


def returned(vertices, faces, rings=5):
    """Principal curvatures and directions. Where it finds too few vertices, libigl returns 0 and
    lists the vertex: NaN here."""
    import igl

    d1, d2, k1, k2, bad = igl.principal_curvature(vertices, faces, rings)
    for values in (k1, k2, d1, d2):
        values[bad] = float("nan")
    return k1, k2, d1, d2


def estimate(mesh, rings: Literal[5, 2, 3, 4] = 5):
    """All six, from the vertices over `rings` rings, whose default is libigl's."""
    return six(mesh, *over_used(returned, mesh, rings=rings))
