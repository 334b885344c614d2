"""Surfaces as images of simple domains, and triangles of points in these.

The torus is the image of the unit square with opposite sides joined, the patch that of the square
[-1, 1]^2, the others are images of the unit sphere along rays or by stretching.
"""

import numpy as np

from curvlib.implicit._exact import exact, nearest
from curvlib.implicit.ellipsoid import SEMI_AXES
from curvlib.implicit.torus import RADII
from curvlib.meshes.jittered import plane, wavy
from curvlib.meshes.mesh import Mesh

# Copies of a periodic domain reach so far beyond it, in mean distances of points.
MARGIN = 8.0


def torus_points(s):
    """Points (m, 3) of the torus at parameters (m, 2), each of period 1: around the axis, around
    the tube."""
    angles = 2 * np.pi * np.asarray(s)
    (c, cv), (sn, sv) = np.cos(angles).T, np.sin(angles).T
    r = RADII[0] + RADII[1] * cv
    return np.stack((r * c, r * sn, RADII[1] * sv), -1)


def patch_points(s):
    """Points (m, 3) of the patch above (m, 2)."""
    x, y = np.asarray(s).T
    return np.stack((x, y, wavy(x, y)), -1)


def sphere_points(surface, rays):
    """Points (m, 3) of the sphere, the ellipsoid or Goursat's cube that belong to unit vectors."""
    if surface == "sphere":
        return rays
    if surface == "ellipsoid":
        return rays * SEMI_AXES
    # Goursat's quartic along a ray is a quadratic equation of the squared distance.
    fourth = (rays**4).sum(1)
    square = (0.5 + np.sqrt(0.25 + 2 * fourth)) / (2 * fourth)
    return nearest(surface, rays * np.sqrt(square)[:, None], along=rays)


def periodic(points, periods):
    """Delaunay triangles of points (m, 2) with copies at all multiples of two periods."""
    periods, count = np.asarray(periods, float), len(points)
    points = points % periods
    margin = MARGIN * np.sqrt(np.prod(periods) / count)
    shifts = np.stack(np.meshgrid([-1, 0, 1], [-1, 0, 1], indexing="ij"), -1).reshape(-1, 1, 2)
    copies = (points + shifts * periods).reshape(-1, 2)
    index = np.tile(np.arange(count), 9)
    near = ((copies > -margin) & (copies < periods + margin)).all(1)
    copies, index = copies[near], index[near]
    faces = plane(*copies.T)
    # Of each triangle's copies the one whose centre lies in the period.
    centre = copies[faces].mean(1)
    return index[faces[((centre >= 0) & (centre < periods)).all(1)]]


def lattice(columns, rows, seed, jitter=0.35):
    """Points (columns rows, 2) of a grid of integers, jittered by up to a part of a step."""
    i, j = np.divmod(np.arange(columns * rows), rows)
    points = np.stack((i, j), -1).astype(float)
    return points + np.random.default_rng(seed).uniform(-jitter, jitter, points.shape)


def with_exact(surface, vertices, faces) -> Mesh:
    """A mesh with exact values at vertices that lie on the surface; vertices without a triangle are
    left out."""
    vertices, faces = used(vertices, faces)
    return Mesh(vertices, faces, **exact(surface, vertices))


def used(vertices, faces):
    """Vertices that have a triangle, and the triangles of them."""
    there = np.zeros(len(vertices), bool)
    there[faces] = True
    return vertices[there], (np.cumsum(there) - 1)[faces]
