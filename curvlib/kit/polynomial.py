"""A surface near a vertex as a polynomial z = f(x, y), fitted to the vertex's disk.

Monomials are ordered by degree, and in a degree by the power of y: 1, x, y, x^2, x y, y^2, ...
The normal equations are solved as L D L^T. Their entries are moments of the points, of which there
are fewer than products of two columns: 45 instead of 120 at degree 4. With coordinates in units of
the disk's radius the coefficients agree with those of a QR of the columns to 1e-12 at degree 6.
"""

import numpy as np

from curvlib.errors import InputError

from .compiled import kernel
from .fit import CUTOFF
from .lanes import LANES, dot, eliminate, multiply, project
from .parts import part
from .vectors import times

HIGHEST = 9  # degree for which Disk.rows and Disk.space suffice
# Numbers for the moments, and for what belongs to each monomial; both multiples of LANES.
MOMENTS, MONOMIALS = 192, 56


@kernel
def terms(degree):
    """The number of monomials up to a degree (-1: none).

    Parameters
    ----------
    degree : int

    Returns
    -------
    int
    """
    return (degree + 1) * (degree + 2) // 2


def _products():
    """The place of the product of monomials i and j in their order."""
    degree = np.repeat(np.arange(HIGHEST + 1), np.arange(HIGHEST + 1) + 1)
    power = np.arange(len(degree)) - degree * (degree + 1) // 2
    both = degree[:, None] + degree
    return (both * (both + 1) // 2 + power[:, None] + power).astype(np.uint8)


PRODUCT = _products()


@kernel
def fit_polynomial(disk, X, Y, N, lowest, degree, sine=CUTOFF):
    """Fit z = f(x, y) with x = e . X, y = e . Y, z = e . N to the neighbours e of a Disk, by
    least squares of the residuals times `disk.weights`.

    Parameters
    ----------
    disk : Disk
    X, Y, N : tuple of 3 floats
        A right-handed orthonormal frame.
    lowest : int
        Lowest degree of a monomial: 0, and the vertex itself is a point of weight 1; or 1, and f
        passes through it.
    degree : int
        Highest degree of a monomial, from 2 to HIGHEST.
    sine : float
        Points determine a polynomial if the column of each monomial has an angle of a larger sine
        to the span of those of higher ones.

    Returns
    -------
    p, q, r, s, t : float
        f_x, f_y, f_xx, f_xy and f_yy at the vertex, in the unit of the disk. NaN where no
        polynomial of degree 2 is determined.
    degree : int
        The highest degree that the points determine, at most `degree`, whose polynomial it is; 1
        where that is below 2.

    Raises
    ------
    InputError
        The degree is above HIGHEST.
    """
    if degree > HIGHEST:
        raise InputError("fit_polynomial: a degree above 9")
    rows, one, count, first = disk.rows, 3, terms(degree), terms(lowest - 1)
    inverse, z = 1 / disk.radius, one + count + 2
    monomials(disk, X, Y, N, degree)
    multiply(rows, z, z, one)
    moments, heights = part(disk.space, 0, (MOMENTS,)), part(disk.space, MOMENTS, (MONOMIALS,))
    sum_moments(rows, 2 * lowest, 2 * degree, moments)
    if lowest == 0:
        moments[0] += 1
    for i in range(first, count):
        heights[i] = dot(rows, one + i, z)
    work = part(disk.space, MOMENTS + MONOMIALS, (2 * MONOMIALS,))
    while degree >= 2:
        # The lowest degrees last: only they are substituted back.
        last = terms(degree) - 1
        p = last + 1 - first
        width = (p + LANES) // LANES * LANES
        system = part(disk.space, MOMENTS + 3 * MONOMIALS, (p, width))
        set_matrix(system, moments, last)
        for i in range(p):
            system[i, p] = heights[last - i]
        if solve(system, 6 - first, work, sine):
            end = p - 1 + first
            curved = inverse * system[end - 3, p], inverse * system[end - 4, p]
            return (
                system[end - 1, p],
                system[end - 2, p],
                2 * curved[0],
                curved[1],
                2 * inverse * system[end - 5, p],
            ), degree
        degree -= 1
    return (np.nan, np.nan, np.nan, np.nan, np.nan), degree


@kernel
def monomials(disk, X, Y, N, degree):
    """Set rows of a Disk, from the fourth on, to its weights times the monomials of x = e . X and
    y = e . Y in units of its radius, then three more to x, y and z = e . N.

    Parameters
    ----------
    disk : Disk
    X, Y, N : tuple of 3 floats
        As in `fit_polynomial`.
    degree : int
        Highest degree of a monomial, at most HIGHEST.
    """
    # The first monomial is 1: the weights, which are row 3.
    rows, inverse, at = disk.rows, 1 / disk.radius, 4
    x = 3 + terms(degree)
    project(rows, x, 0, times(X, inverse))
    project(rows, x + 1, 0, times(Y, inverse))
    project(rows, x + 2, 0, times(N, inverse))
    for s in range(1, degree + 1):
        for _ in range(s):
            multiply(rows, at, at - s, x)
            at += 1
        multiply(rows, at, at - s - 1, x + 1)
        at += 1


@kernel
def sum_moments(rows, lowest, highest, moments):
    """Set the moments of a range of degrees, each the sum of the product of two monomials.

    Parameters
    ----------
    rows : (ROWS, n)
        As `monomials` leaves them, of half the highest degree.
    lowest, highest : int
    moments : (MOMENTS,)
        Written to at the places of these degrees in the order of monomials.
    """
    at = terms(lowest - 1)
    for s in range(lowest, highest + 1):
        half = (s + 1) // 2
        for j in range(s + 1):
            of_half = min(j, half)
            a, b = terms(half - 1) + of_half, terms(s - half - 1) + j - of_half
            moments[at] = dot(rows, 3 + a, 3 + b)
            at += 1


@kernel
def set_matrix(system, moments, last):
    """Set the matrix of normal equations, on and above the diagonal, the highest monomial first.

    Parameters
    ----------
    system : (p, n)
        Zero elsewhere.
    moments : (MOMENTS,)
        From `sum_moments`.
    last : int
        Place of the highest monomial in their order.
    """
    p, width = system.shape
    for i in range(p):
        # `eliminate` runs over whole vectors. What memory held may be subnormal, and is twice as
        # slow for it.
        for k in range(width):
            system[i, k] = 0.0
        for k in range(i, p):
            system[i, k] = moments[PRODUCT[last - i, last - k]]


@kernel
def solve(system, wanted, work, sine=CUTOFF):
    """Solve normal equations by L D L^T without pivoting.

    Parameters
    ----------
    system : (p, n)
        The matrix on and above the diagonal, the right-hand side in column p; n is a multiple of
        LANES. Overwritten by D L^T, and column p by the solution, in its last `wanted` rows.
    wanted : int
    work : (2 p or more,)
        Overwritten.
    sine : float
        As in `fit_polynomial`.

    Returns
    -------
    bool
        Whether each pivot exceeds sine^2 times its entry on the diagonal: it is the square of the
        sine of the angle between a column and the span of those before it.
    """
    p = len(system)
    for k in range(p):
        work[p + k] = sine * sine * system[k, k]
    for k in range(p):
        if not system[k, k] > work[p + k]:
            return False
        inverse = 1 / system[k, k]
        for i in range(k + 1, p):
            work[i] = system[k, i] * inverse
        eliminate(system, k, work)
    for k in range(p - 1, p - 1 - wanted, -1):
        value = system[k, p]
        for j in range(k + 1, p):
            value -= system[k, j] * system[j, p]
        system[k, p] = value / system[k, k]
    return True
