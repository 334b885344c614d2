"""Variances of the curvatures of a fitted polynomial, from the normal equations that it solved.

Noise of variance s^2 in the heights gives a functional c of the coefficients the variance
s^2 c^T G^-1 c, G being the matrix of the equations. The last columns of the factor of G = L D L^T
belong to the lowest monomials: where c needs these alone, one substitution through them is enough.
"""

import numpy as np

from .compiled import kernel
from .lanes import LANES, dot
from .parts import part
from .polynomial import MOMENTS, MONOMIALS, terms

LAST = 6  # monomials up to degree 2
# Principal curvatures that differ by less than this part of the larger vary as H does.
EQUAL = 1e-6


@kernel
def variances(disk, derivatives, values, degree, reached):
    """Of what `fit_polynomial` with a constant left in a Disk whose weights are 1.

    Parameters
    ----------
    disk : Disk
        Its space is overwritten in part.
    derivatives : tuple of 5 floats
        Those that it returned.
    values : Curvatures
        Of these, by `from_graph`.
    degree, reached : int
        That it was given, and that it returned.

    Returns
    -------
    K, H, k1, k2 : float
        Variances of the curvatures, to the first order, per variance of the heights.
    across : float
        That of the second fundamental form across a principal direction, by which noise drives k1
        and k2 apart: in the mean of all directions.
    squares : float
        The sum of the squares of the residuals, in the unit of the disk.
    freedom : float
        How many points there are more than coefficients.

    Notes
    -----
    The noise is independent from vertex to vertex and lies along the axis of the heights. The sum
    of squares is what the equations leave of that of the heights, right to 1e-15 of the latter.
    """
    nothing = (np.nan, np.nan, np.nan, np.nan, np.nan, np.nan, np.nan)
    if reached < 2:
        return nothing
    p, z, inverse = terms(reached), 5 + terms(degree), 1 / disk.radius
    width = (p + LANES) // LANES * LANES
    system = part(disk.space, MOMENTS + 3 * MONOMIALS, (p, width))
    squares = dot(disk.rows, z, z)
    for i in range(p):
        value = system[i, p]
        if i >= p - LAST:  # where the solution stands: back to the right-hand side
            value *= system[i, i]
            for k in range(i + 1, p):
                value += system[i, k] * system[k, p]
        squares -= value * value / system[i, i]
    by = part(disk.space, MOMENTS, (6, LAST))
    _set_gradients(by, derivatives, values, inverse)
    found = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    for i in range(LAST):
        at = p - LAST + i
        over = 1 / system[at, at]
        for k in range(i + 1, LAST):
            factor = system[at, at - i + k] * over
            for f in range(6):
                by[f, k] -= factor * by[f, i]
        found = (
            found[0] + by[0, i] * by[0, i] * over,
            found[1] + by[1, i] * by[1, i] * over,
            found[2] + by[2, i] * by[2, i] * over,
            found[3] + by[3, i] * by[3, i] * over,
            found[4] + by[4, i] * by[4, i] * over,
            found[5] + by[5, i] * by[5, i] * over,
        )
    square = inverse * inverse
    return (
        found[0] * square,
        found[1] * square,
        found[2] * square,
        found[3] * square,
        (found[4] + found[5]) / 2 * square,
        max(squares, 0.0) / square,
        disk.count + 1.0 - p,
    )


@kernel
def _set_gradients(by, derivatives, values, inverse):
    """Set rows of (6, LAST) to the derivatives of K, H, k1, k2, (f_xx - f_yy) / 2 and f_xy by the
    coefficients of y^2, x y, x^2, y, x and 1 in units of a radius, 1 / `inverse`."""
    p, q, r, s, t = derivatives
    over = 1 / (1 + p * p + q * q)
    area = np.sqrt(over)
    K, H, k1, k2 = values.K, values.H, values.k1, values.k2
    of_K, of_H = over * over, -0.5 * over * area
    twice = 2 * inverse
    by[0, 0], by[0, 1], by[0, 2] = of_K * r * twice, -2 * of_K * s * inverse, of_K * t * twice
    by[0, 3], by[0, 4] = -4 * K * q * over, -4 * K * p * over
    by[1, 0], by[1, 2] = of_H * (1 + p * p) * twice, of_H * (1 + q * q) * twice
    by[1, 1] = -2 * of_H * p * q * inverse
    by[1, 3] = 2 * of_H * (q * r - p * s) - 3 * H * q * over
    by[1, 4] = 2 * of_H * (p * t - q * s) - 3 * H * p * over
    gap = (k1 - k2) / 2
    apart = gap > EQUAL * max(abs(k1), abs(k2))
    half = 0.5 / gap if apart else 0.0
    for i in range(5):
        # k^2 - 2 H k + K = 0.
        dK, dH = by[0, i], by[1, i]
        by[2, i] = (2 * k1 * dH - dK) * half if apart else dH
        by[3, i] = (dK - 2 * k2 * dH) * half if apart else dH
        by[4, i], by[5, i] = 0.0, 0.0
    by[4, 0], by[4, 2], by[5, 1] = -inverse, inverse, inverse
    for f in range(6):
        by[f, 5] = 0.0
