"""Simulated range scans: rays of a grid from one side, with what they cannot see left out."""

import itertools

import numpy as np

from curvlib.catalogue import implicit
from curvlib.families._charts import used
from curvlib.implicit._exact import exact_mesh

LABEL = "Simulated scans"
SURFACES = ("ellipsoid", "genus_3", "goursat", "torus")

QUANTUM = 0.05  # of depth, in distances of rays
HOLES, RADIUS = 5, 3.0  # of missing samples, and their radius in rays
DROPPED = 0.005  # of the samples, at random
STEEP = 3.0  # depths of neighbours that differ by more rays lie on two sides of an edge
FIRST = 64  # rays of an overview, along a side
STEPS, HALVINGS = 160, 40
# From the surface's axes to the scanner's, which looks along -z: two turns, about x and y.
TILT, PAN = 0.6, 0.4


def make(surface, n, seed):
    """n x n rays in parallel over the part of the view that the surface fills.

    Each sample is the first point of the surface on its ray, with depth in steps of a twentieth of
    the rays' distance. Samples are missing in five holes and at random; neighbours across a jump of
    depth are not joined. Vertices are near to the surface, exact values those at the nearest point.
    """
    turn, half = _turn(), np.linalg.norm(implicit.module(surface).BOX)
    overview = _rays(np.zeros(2), half, FIRST)
    seen = overview[np.isfinite(_first(surface, overview, half, turn))]
    middle, extent = (seen.max(0) + seen.min(0)) / 2, np.ptp(seen, axis=0).max() / 2
    rays, distance = _rays(middle, extent, n), 2 * extent / n
    depth = _first(surface, rays, half, turn)
    depth = np.round(depth / (QUANTUM * distance)) * (QUANTUM * distance)
    rng, seen = np.random.default_rng(seed), np.isfinite(depth)
    centres = rays[seen][rng.choice(seen.sum(), HOLES, replace=False)]
    away = np.linalg.norm(rays[:, None] - centres, axis=2).min(1)
    seen &= (away > RADIUS * distance) & (rng.random(n * n) > DROPPED)
    points = np.column_stack((rays, depth)) @ turn
    faces = _joined(seen, np.where(seen, depth, 0), n, STEEP * distance)
    return exact_mesh(surface, *used(np.where(seen[:, None], points, 0), faces))


def _turn():
    (c, cp), (s, sp) = np.cos((TILT, PAN)), np.sin((TILT, PAN))
    about_x = np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    return np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]]) @ about_x


def _rays(middle, half, n):
    """Where n x n rays meet the plane z = 0, (n^2, 2): a square of half a side `half`."""
    cells = np.stack(np.divmod(np.arange(n * n), n), -1) + 0.5
    return middle + half * (2 * cells / n - 1)


def _first(surface, rays, half, turn):
    """The largest z at which a ray (m, 2) meets the surface, (m,); NaN where it does not."""
    level = implicit.module(surface).level

    def outside(z):
        return level(*(np.column_stack((rays, z)) @ turn).T)[0] > 0

    levels = half * np.linspace(1, -1, STEPS + 1)
    above, below = np.full(len(rays), np.nan), np.full(len(rays), np.nan)
    for high, low in itertools.pairwise(levels):
        first = np.isnan(below) & ~outside(np.full(len(rays), low))
        above[first], below[first] = high, low
    for _ in range(HALVINGS):
        middle = (above + below) / 2
        out = outside(middle)
        above, below = np.where(out, middle, above), np.where(out, below, middle)
    return np.where(np.isnan(below), np.nan, above)


def _joined(seen, depth, n, jump):
    """Triangles between samples of a grid that are seen, where depth has no jump; counter-clockwise
    from above."""
    a = (np.arange(n * n).reshape(n, n)[:-1, :-1]).ravel()
    b, c, d = a + n, a + n + 1, a + 1
    faces = np.concatenate([np.stack((a, b, c), -1), np.stack((a, c, d), -1)])
    there = seen[faces].all(1) & (np.ptp(depth[faces], axis=1) < jump)
    return faces[there]
