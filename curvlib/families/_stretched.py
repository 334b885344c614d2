"""Meshes of long triangles: jittered lattices whose steps differ tenfold."""

import numpy as np

from curvlib.families._charts import (
    lattice,
    patch_points,
    periodic,
    torus_points,
    with_exact,
)
from curvlib.implicit.torus import RADII
from curvlib.meshes.jittered import plane

RATIO = 10.0
# Turns of the helix around the tube in one around the axis, at about 45 degrees.
HELIX = 3


def stretched(surface, n, seed, turned):
    """About n^2 vertices; `turned`: 0 along the parameters, 1 at about 45 degrees from them."""
    return (_torus if surface == "torus" else _patch)(surface, n, seed, turned)


def _torus(surface, n, seed, turned):
    # Each of the lattice's columns is a circle around the tube; a lattice sheared by whole turns
    # closes up. Long steps lead from column to column, short ones along it.
    slope = turned * HELIX * RADII[1] / RADII[0]
    along, across = RADII[0] * np.hypot(1, slope), RADII[1] / np.hypot(1, slope)
    columns = max(round(n * np.sqrt(along / across / RATIO)), 4)
    rows = max(round(n * n / columns), 8)
    points = lattice(columns, rows, seed)
    faces = periodic(points, (columns, rows))
    u, v = (points / (columns, rows)).T
    return with_exact(surface, torus_points(np.stack((u, v + HELIX * turned * u), -1)), faces)


def _patch(surface, n, seed, turned):
    # A lattice that covers the square, turned, and what of it lies inside.
    long, wide = 2 / n * np.sqrt(RATIO), 2 / n / np.sqrt(RATIO)
    columns, rows = (int(np.ceil(3 / step)) for step in (long, wide))
    points = lattice(columns, rows, seed) - ((columns - 1) / 2, (rows - 1) / 2)
    angle = turned * np.pi / 4
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    s = points * (long, wide) @ turn
    inside = (np.abs(s) < 1).all(1)
    faces = plane(*points[inside].T)
    # The hull of a ragged rim has slivers that no lattice has: sides of several steps.
    ends = points[inside][faces]
    sides = np.abs(ends - np.roll(ends, 1, 1)).max((1, 2))
    return with_exact(surface, patch_points(s[inside]), faces[sides < 2.5])
