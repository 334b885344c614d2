"""Vertices far off the surface of their neighbours: found, and brought back to it.

One such vertex spoils every fit that it has a part in. Three functions of disks, each the field of
the next: `suspects`, `displaced` and `placed`.
"""

from typing import Literal

import numpy as np

from .compiled import kernel
from .disk import Disk
from .lanes import LANES, dot, multiply
from .parts import part
from .polynomial import MOMENTS, MONOMIALS, monomials, set_matrix, solve, sum_moments, terms
from .reweighted import (
    UNKNOWNS,
    WEIGHT,
    consistency,
    fit_absolute,
    fit_biweight,
    median_normal,
    weigh_by_distance,
)
from .vectors import add, tangents, times
from .vectors import dot as along

# A height above the quadric of SCALES of its residuals or more, and HIGH radii of the ring or more,
# is no noise. Beyond WIDE radii from its middle a vertex lies outside the ring, on a
# boundary beyond twice as many.
SCALES, HIGH, WIDE = 8.0, 0.7, 2.0
TUNING = 4.685  # of the biweight, in scales: 95 % efficient under Gaussian noise
DEGREE = 4


@kernel
def suspects(disk):
    """The normal of a vertex; and 1 where it lies farther from the mean of its neighbours than
    these in the root mean square, else 0.

    Parameters
    ----------
    disk : Disk
        Of one ring.

    Returns
    -------
    x, y, z, suspect : float
    """
    total, squares = (0.0, 0.0, 0.0), 0.0
    for i in range(disk.count):
        e = disk.e[0, i], disk.e[1, i], disk.e[2, i]
        total, squares = add(total, 1.0, e), squares + along(e, e)
    # |mean|^2 > mean |e|^2 - |mean|^2
    far = 2 * along(total, total) > disk.count * squares
    N = disk.normal
    return N[0], N[1], N[2], 1.0 if far else 0.0


@kernel
def displaced(disk, suspects, rings: Literal[3] = 3):
    """The median of the normals near a vertex; and 1 where it lies far from the quadric near most
    of its neighbours, or outside its ring, else 0.

    Parameters
    ----------
    disk : Disk
    suspects : (4, 1 + n)
    rings : {3}

    Returns
    -------
    x, y, z, displaced : float
    """
    if suspects[3, 0] == 0:
        return suspects[0, 0], suspects[1, 0], suspects[2, 0], 0.0
    e, weights, hops, distances, normal, exact, area, closed, _, count, rows, space, walk = disk
    size, factor = weigh_by_distance(disk), consistency(count)
    own = normal, exact, area, closed, size, count, rows, space, walk
    sized = Disk(e, weights, hops, distances, *own)
    quadric = part(space, 88, (UNKNOWNS + 1,))
    N = median_normal(disk, suspects)
    X, Y = tangents(N)
    monomials(sized, X, Y, N, 4)
    if not fit_absolute(sized, quadric, factor, 0.0):
        return N[0], N[1], N[2], 0.0
    found = fit_biweight(sized, quadric, factor, TUNING, 0.0)
    for i in range(count):
        weights[i] = rows[WEIGHT, i]
    x, y, radius = _middle(disk, X, Y)
    height = abs(quadric[0])
    high = height > SCALES * found and size * height > HIGH * radius
    wide = x * x + y * y > ((WIDE if closed else 2 * WIDE) * radius) ** 2
    return N[0], N[1], N[2], 1.0 if found < np.inf and (high or wide) else 0.0


@kernel
def placed(disk, displaced, rings: Literal[3] = 3):
    """From a displaced vertex to the polynomial of degree 4 fitted to its neighbours that are not
    displaced: along the median normal, or to the middle of the ring from outside of it.

    Parameters
    ----------
    disk : Disk
    displaced : (4, 1 + n)
    rings : {3}

    Returns
    -------
    x, y, z : float
        NaN where the neighbours determine no polynomial of degree 2.
    """
    N = displaced[0, 0], displaced[1, 0], displaced[2, 0]
    X, Y = tangents(N)
    for i in range(disk.count):
        disk.weights[i] = 1.0 if displaced[3, 1 + i] == 0 else 0.0
    x, y, radius = _middle(disk, X, Y)
    if x * x + y * y < radius * radius:
        x, y = 0.0, 0.0
    move = add(times(X, x), y, Y)
    for i in range(disk.count):
        for k in range(3):
            disk.e[k, i] -= move[k]
    return add(move, _height(disk, X, Y, N), N)


@kernel
def _middle(disk, X, Y):
    """The mean of the neighbours in the first ring that have a weight, in coordinates along X and
    Y, and their root mean square distance from it."""
    total, x, y, squares = 0.0, 0.0, 0.0, 0.0
    for i in range(disk.count):
        if disk.hops[i] == 1 and disk.weights[i] > 0:
            e = disk.e[0, i], disk.e[1, i], disk.e[2, i]
            u, v = along(e, X), along(e, Y)
            total, x, y, squares = total + 1, x + u, y + v, squares + u * u + v * v
    x, y = x / total, y / total
    return x, y, np.sqrt(squares / total - x * x - y * y)


@kernel
def _height(disk, X, Y, N):
    """The height at the origin of a polynomial fitted to the neighbours alone."""
    rows, space, degree = disk.rows, disk.space, DEGREE
    z = 3 + terms(degree) + 2
    monomials(disk, X, Y, N, degree)
    multiply(rows, z, z, 3)
    moments, work = part(space, 0, (MOMENTS,)), part(space, MOMENTS, (2 * MONOMIALS,))
    sum_moments(rows, 0, 2 * degree, moments)
    while degree >= 2:
        p = terms(degree)
        system = part(space, MOMENTS + 2 * MONOMIALS, (p, (p + LANES) // LANES * LANES))
        set_matrix(system, moments, p - 1)
        for i in range(p):
            system[i, p] = dot(rows, 2 + p - i, z)
        if solve(system, 1, work):
            return disk.radius * system[p - 1, p]
        degree -= 1
    return np.nan
