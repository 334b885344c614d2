"""Gather one-rings from the vertices of a mesh, scatter values to the vertices."""

import math

import numpy as np

from .compiled import compiled
from .ring import ROUNDING, defined, owning_ring

SMALLEST = np.finfo(float).tiny


def gather(vertices, normals, centres, neighbours, start, end, unit):
    """Gather the Ring of the vertices centres[start:end].

    Parameters
    ----------
    vertices : (V, 3)
        Coordinates, in the unit of the mesh.
    normals : (V, 3) or (0, 3)
        Unit normals of the surface at the vertices, where the mesh has them.
    centres : (M,) int32
        Vertices v of one valence n.
    neighbours : (n, M) int32
        v_0 ... v_{n-1} of each of them.
    start, end : int
        Which of the M.
    unit : float
        `Mesh.unit`: lengths of the Ring are multiplied by it.

    Returns
    -------
    Ring
    """
    return defined(*_gather(vertices, normals, centres, neighbours, start, end, unit))


@compiled
def _gather(vertices, normals, centres, neighbours, start, end, unit):
    n, m = len(neighbours), end - start
    e, v, floors = np.empty((3, n, m)), np.empty((3, m)), np.empty(m)
    for k in range(m):
        # Unsigned indices spare the test for negative ones.
        row = np.uint64(centres[start + k])
        v[0, k], v[1, k], v[2, k] = vertices[row, 0], vertices[row, 1], vertices[row, 2]
    for i in range(n):
        for k in range(m):
            row = np.uint64(neighbours[i, start + k])
            for c in range(3):
                e[c, i, k] = (vertices[row, c] - v[c, k]) * unit
    for k in range(m):
        x, y, z = v[0, k] * unit, v[1, k] * unit, v[2, k] * unit
        floors[k] = ROUNDING**2 * (x * x + y * y + z * z)
    exact_normals = np.empty((3, m if len(normals) else 0))
    for k in range(exact_normals.shape[1]):
        for c in range(3):
            exact_normals[c, k] = normals[centres[start + k], c]
    return owning_ring(e, exact_normals, floors)


@compiled
def scatter(values, centres, start, target, unit, power):
    """Scatter values (m,) to target[centres[start:start + m]], `settled` in the unit of the mesh.

    Parameters
    ----------
    values : (m,)
        In the unit of the Ring.
    centres : (M,) int32
        Vertices.
    start : int
        Place of the first of the m in `centres`.
    target : (V,)
        Written to.
    unit : float
        As in `gather`.
    power : int
        Of 1/length that the values scale with: 2 for K, 1 for H, 0 for directions.
    """
    for k in range(len(values)):
        target[centres[start + k]] = settled(values[k], unit, power)


@compiled
def settled(value, unit, power):
    """A value in the unit of the mesh, NaN where it is undefined.

    The only place that makes NaN of undefined values: infinite ones, and those that are subnormal
    or underflow in the unit of the mesh.

    Parameters
    ----------
    value : float
        In the unit of the Ring or Disk.
    unit : float
        As in `gather`.
    power : int
        As in `scatter`.

    Returns
    -------
    float
    """
    found = value
    for _ in range(power):
        found *= unit
    lost = abs(found) < SMALLEST and value != 0
    return found if math.isfinite(found) and not lost else math.nan
