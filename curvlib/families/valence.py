"""Vertices of valence 3 beside such of many neighbours."""

import numpy as np

from curvlib.catalogue import families
from curvlib.implicit._exact import on_surface

LABEL = "Irregular valence"
SURFACES = ("ellipsoid", "goursat", "patch", "torus")
SPLIT = 0.25  # of the triangles


def make(surface, n, seed):
    """About n^2 vertices: of a jittered mesh a quarter of the triangles, chosen at random, get a
    vertex of valence 3 at their centre, moved to the surface."""
    coarse = families.module("jittered").make(surface, round(n / np.sqrt(1 + 2 * SPLIT)), seed)
    rng, faces = np.random.default_rng(seed + 1), coarse.faces
    chosen = np.sort(rng.choice(len(faces), round(SPLIT * len(faces)), replace=False))
    centres = coarse.vertices[faces[chosen]].mean(1)
    new = len(coarse.vertices) + np.arange(len(chosen))
    a, b, c = faces[chosen].T
    split = [np.stack(corners, 1) for corners in ((a, b, new), (b, c, new), (c, a, new))]
    faces = np.concatenate([np.delete(faces, chosen, 0), *split])
    return on_surface(surface, np.concatenate([coarse.vertices, centres]), faces)
