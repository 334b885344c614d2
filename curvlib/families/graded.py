"""Edges thirty times as long on one side of the surface as on the other."""

import numpy as np

from curvlib.families._charts import (
    lattice,
    patch_points,
    periodic,
    sphere_points,
    torus_points,
    with_exact,
)
from curvlib.meshes.jittered import hull, plane, spiral

LABEL = "Graded 1:30"
SURFACES = ("ellipsoid", "goursat", "patch", "torus")
RATIO = 30.0


def make(surface, n, seed):
    """n^2 vertices. On the torus edges around the axis are graded, on the patch those along x and
    along y, on the others all, by a conformal map of the sphere."""
    if surface == "torus":
        points = lattice(n, n, seed)
        u, v = (points / n).T
        part = (RATIO - 1) / (RATIO + 1)
        u = u - part * np.sin(2 * np.pi * u) / (2 * np.pi)
        return with_exact(surface, torus_points(np.stack((u, v), -1)), periodic(points, (n, n)))
    if surface == "patch":
        points = lattice(n, n, seed)
        rim = (points < 0.5) | (points > n - 1.5)  # stays straight
        points = np.where(rim, np.round(points), points)
        t = points / (n - 1)
        s = 2 * (RATIO**t - 1) / (RATIO - 1) - 1
        return with_exact(surface, patch_points(s), plane(*points.T))
    x, y, z = spiral(n, seed).T
    # Stereographic projection, enlarged: lengths are RATIO^(1/2) times at one pole, and its
    # inverse at the other.
    grown = np.sqrt(RATIO) * np.sqrt((1 + z) / (1 - z))
    new = (grown * grown - 1) / (grown * grown + 1)
    around = np.sqrt(1 - new * new) / np.hypot(x, y)
    rays = np.stack((x * around, y * around, new), -1)
    return with_exact(surface, sphere_points(surface, rays), hull(rays))
