"""Gather one-rings from the vertices of a mesh, scatter values to the vertices."""

import math

import numpy as np

from .compiled import compiled
from .ring import ROUNDING, owning_ring

# Coordinates within the range of float32 are not scaled: fifth powers of lengths fit float64.
RANGE = 2.0**128
SMALLEST = np.finfo(float).tiny


def unit(vertices) -> float:
    """The power of two by which coordinates are multiplied, so that no product of lengths
    overflows or underflows.

    Parameters
    ----------
    vertices : ndarray of float64, (V, 3)
        Coordinates of the mesh, finite.

    Returns
    -------
    float
        1 where the largest absolute coordinate lies between 3e-39 and 3e38, or is zero.

    Examples
    --------
    >>> unit(np.array([[0.0, 1.0, 2.0]]))
    1.0
    >>> unit(np.array([[0.0, 0.0, 2.0**200]])) == 2.0**-201
    True
    """
    largest = max(vertices.max(), -vertices.min()) if len(vertices) else 0.0
    if largest == 0 or 1 / RANGE <= largest <= RANGE:
        return 1.0
    # At most 2^1023: the inverse of a subnormal number is no float64.
    return math.ldexp(1.0, min(-math.frexp(largest)[1], 1023))


@compiled
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
        `unit(vertices)`: lengths of the Ring are multiplied by it.

    Returns
    -------
    Ring
    """
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
    """Scatter values (m,) to target[centres[start:start + m]], in the unit of the mesh.

    The only place that turns undefined values into NaN: infinite ones, and those that are
    subnormal or underflow in the unit of the mesh.

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
        value = values[k]
        for _ in range(power):
            value *= unit
        lost = abs(value) < SMALLEST and values[k] != 0
        target[centres[start + k]] = value if math.isfinite(value) and not lost else math.nan
