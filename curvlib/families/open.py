"""Meshes with holes: most of what lies near a boundary is counted as such."""

import numpy as np

from curvlib.catalogue import families
from curvlib.families._charts import with_exact

LABEL = "Open, with boundary"
SURFACES = ("ellipsoid", "goursat", "patch", "torus")
HOLES = 6


def make(surface, n, seed):
    """Somewhat fewer than n^2 vertices: of a jittered mesh six balls are cut out, whose radius is a
    fifth of the least extent."""
    whole = families.module("jittered").make(surface, n, seed)
    rng = np.random.default_rng(seed + 1)
    radius = 0.2 * np.ptp(whole.vertices, axis=0).min()
    centres = whole.vertices[rng.choice(len(whole.vertices), HOLES, replace=False)]
    away = np.linalg.norm(whole.vertices[:, None] - centres, axis=2).min(1) > radius
    return with_exact(surface, whole.vertices, whole.faces[away[whole.faces].all(1)])
