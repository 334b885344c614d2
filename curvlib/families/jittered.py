"""Points of a jittered grid, joined by Delaunay."""

from curvlib.families._charts import sphere_points, with_exact
from curvlib.meshes import jittered
from curvlib.meshes.jittered import hull, spiral

LABEL = "Jittered Delaunay"
SURFACES = ("ellipsoid", "goursat", "patch", "torus")


def make(surface, n, seed):
    """n^2 vertices; steps are jittered by up to 35 %."""
    if surface in jittered.SURFACES:
        return jittered.jittered(surface, n, seed)
    rays = spiral(n, seed)
    return with_exact(surface, sphere_points(surface, rays), hull(rays))
