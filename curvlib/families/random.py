"""Random points, uniform by area in space, joined by Delaunay."""

import numpy as np

from curvlib.families._charts import (
    patch_points,
    periodic,
    sphere_points,
    torus_points,
    with_exact,
)
from curvlib.implicit.torus import RADII
from curvlib.meshes.jittered import hull, plane

LABEL = "Random points"
SURFACES = ("ellipsoid", "goursat", "patch", "torus")

# Length of the torus around the axis over that around the tube.
ASPECT = RADII[0] / RADII[1]
STEP = 1e-5  # of difference quotients, for area elements


def make(surface, n, seed):
    """n^2 vertices; on the patch the corners and n - 2 points of each side are among them."""
    rng = np.random.default_rng(seed)
    if surface == "torus":
        s = _by_area(lambda m: rng.random((m, 2)), torus_points, n * n, rng)
        return with_exact(surface, torus_points(s), periodic(s * (ASPECT, 1), (ASPECT, 1)))
    if surface == "patch":
        along, side = rng.uniform(-1, 1, 4 * (n - 2)), np.arange(4 * (n - 2)) % 4
        across = np.where(side < 2, -1.0, 1.0)
        turned = (side % 2 == 0)[:, None]
        rim = np.where(turned, np.stack((along, across), 1), np.stack((across, along), 1))
        corners = [[-1, -1], [-1, 1], [1, -1], [1, 1]]
        inside = _by_area(lambda m: rng.uniform(-1, 1, (m, 2)), patch_points, (n - 2) ** 2, rng)
        s = np.concatenate([corners, rim, inside])
        return with_exact(surface, patch_points(s), plane(*s.T))

    def image(rays):
        return sphere_points(surface, rays / np.linalg.norm(rays, axis=1)[:, None])

    def draw(m):
        rays = rng.standard_normal((m, 3))
        return rays / np.linalg.norm(rays, axis=1)[:, None]

    rays = _by_area(draw, image, n * n, rng)
    return with_exact(surface, sphere_points(surface, rays), hull(rays))


def _by_area(draw, image, count, rng):
    """`count` parameters whose images are uniform by area: drawn ones are kept with a chance in
    proportion to the area element."""
    drawn = draw(20 * count)
    area = _area_element(drawn, image)
    kept = drawn[rng.random(len(drawn)) * area.max() < area]
    return kept[:count] if len(kept) >= count else np.concatenate([kept, draw(count - len(kept))])


def _area_element(s, image):
    """How a map (m, 2) or of unit vectors (m, 3) to space enlarges areas, by differences."""
    if s.shape[1] == 2:
        tangents = np.eye(2)[:, None] * np.ones((2, len(s), 1))
    else:
        least = np.eye(3)[np.abs(s).argmin(1)]
        first = np.cross(s, least)
        first /= np.linalg.norm(first, axis=1)[:, None]
        tangents = first, np.cross(s, first)
    moved = [(image(s + STEP * t) - image(s - STEP * t)) / (2 * STEP) for t in tangents]
    return np.linalg.norm(np.cross(*moved), axis=1)
