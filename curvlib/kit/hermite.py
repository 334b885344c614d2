"""A surface near a vertex as a polynomial z = f(x, y) through it, fitted to heights and slopes.

The polynomial depends linearly on both: besides its own derivatives a fit gives those by the slopes
at the neighbours. Its normal equations are made of the same moments as those of a fit to heights,
since derivatives of monomials are monomials; and so are the derivatives by slopes.
"""

import numpy as np

from .combinations import combine, substitute
from .compiled import kernel
from .lanes import LANES, dot, multiply, project
from .parts import part
from .polynomial import MOMENTS, MONOMIALS, PRODUCT, monomials, solve, sum_moments, terms
from .vectors import add, cross, tangents, times
from .vectors import dot as along

STEEPEST = 6  # degree for which Disk.rows suffice
# Places in Disk.rows. The monomials begin at the weights.
ONE, X_ROW, Y_ROW, SLOPES, FUNCTIONALS = 3, 31, 32, 34, 36
SYSTEM = MOMENTS + 3 * MONOMIALS  # in Disk.space


def _tables():
    """Of products of two monomials: powers of x and y, and the place of the product of their
    derivatives by x and by y."""
    degree = np.repeat(np.arange(STEEPEST + 1), np.arange(STEEPEST + 1) + 1)
    power = np.arange(len(degree)) - degree * (degree + 1) // 2
    both, of_y = degree[:, None] + degree, power[:, None] + power
    x, y = degree - power, power
    below = (both - 2) * (both - 1) // 2
    by_x, by_y = x[:, None] * x, y[:, None] * y
    place_x, place_y = np.where(by_x, below + of_y, 0), np.where(by_y, below + of_y - 2, 0)
    return (
        by_x.astype(float),
        by_y.astype(float),
        place_x.astype(np.uint8),
        place_y.astype(np.uint8),
    )


BY_X, BY_Y, PLACE_X, PLACE_Y = _tables()


@kernel
def fit_hermite(disk, normals, X, Y, N, degree, weight, sine):
    """Fit z = f(x, y), f(0, 0) = 0, to the neighbours e of a Disk.

    Least squares of the residuals of z and, times `weight`, of the derivatives of z along the axes
    of whitened coordinates: those in which the second moments of x and y are half the identity.

    Parameters
    ----------
    disk : Disk
        Its rows and weights are overwritten.
    normals : (3 or more, 1 + n)
        Unit normals of the vertex and of the neighbours, which slopes belong to.
    X, Y, N : tuple of 3 floats
        A right-handed orthonormal frame: x = e . X, y = e . Y, z = e . N.
    degree : int
        From 2 to STEEPEST.
    weight : float
    sine : float
        As in `fit_polynomial`.

    Returns
    -------
    derivatives : tuple of 5 floats
        p, q, r, s, t = f_x, f_y, f_xx, f_xy and f_yy at the vertex.
    gain : float
        The Frobenius norm of the map from the angles of the normals at the neighbours to the slope
        at the vertex, in whitened coordinates. Infinite where the points do not determine f.
    derivatives : (10, n)
        Of p, q, r, s, t by u and v, the normal of a neighbour changing to N_j - u X_j - v Y_j with
        X_j, Y_j = tangents(N_j): p by u, p by v, q by u, ...
    """
    rows, count, inverse = disk.rows, disk.count, 1 / disk.radius
    p, n = terms(degree) - 1, disk.rows.shape[1]
    derivatives = part(disk.walk.space, FUNCTIONALS * n, (10, n))
    project(rows, X_ROW, 0, times(X, inverse))
    project(rows, Y_ROW, 0, times(Y, inverse))
    multiply(rows, X_ROW, X_ROW, ONE)
    multiply(rows, Y_ROW, Y_ROW, ONE)
    half = 0.5 * count
    xx, xy = dot(rows, X_ROW, X_ROW) / half, dot(rows, X_ROW, Y_ROW) / half
    l11 = np.sqrt(xx)
    l21 = xy / l11
    l22 = np.sqrt(dot(rows, Y_ROW, Y_ROW) / half - l21 * l21)
    undetermined = (np.nan, np.nan, np.nan, np.nan, np.nan), np.inf, derivatives
    if not l22 > sine * l11 or 3 * count <= p:
        return undetermined
    a, b = inverse / l11, inverse / l22
    c = -l21 / l11 * b
    axes = a, b, c
    A, B = times(X, a), add(times(X, c), b, Y)
    # In the unit of the disk, `monomials` divides by the radius.
    scaled = times(A, disk.radius), times(B, disk.radius), times(N, disk.radius)
    monomials(disk, *scaled, degree)
    # Slopes along the whitened axes are those along U and V in space.
    U, V = add(times(X, 1 / a), -c / (a * b), Y), times(Y, 1 / b)
    for i in range(count):
        m = normals[0, 1 + i], normals[1, 1 + i], normals[2, 1 + i]
        steep = -1 / along(m, N)
        rows[SLOPES, i], rows[SLOPES + 1, i] = steep * along(m, U), steep * along(m, V)
    for i in range(count, n):
        rows[SLOPES, i], rows[SLOPES + 1, i] = 0.0, 0.0
    square = weight * weight
    space = disk.space
    width = (p + LANES) // LANES * LANES
    system = part(space, SYSTEM, (p, width))
    _equations(rows, degree, square, part(space, 0, (MOMENTS,)), system)
    work = part(space, MOMENTS, (2 * MONOMIALS,))
    if not solve(system, 5, work, sine):
        return undetermined
    f = _derivatives(
        system[p - 1, p],
        system[p - 2, p],
        system[p - 3, p],
        system[p - 4, p],
        system[p - 5, p],
        axes,
    )
    room = part(space, SYSTEM + p * width, (p, LANES))
    _inverse(system, room, space)
    _by_slopes(rows, degree, square, room, space)
    gain = _to_normals(rows, normals, count, N, U, V, axes)
    return f, gain, derivatives


@kernel
def _derivatives(c10, c01, c20, c11, c02, axes):
    """p, q, r, s and t of coefficients in whitened coordinates a x and c x + b y."""
    (a, b, c), xx, xy, yy = axes, 2 * c20, c11, 2 * c02
    return (
        a * c10 + c * c01,
        b * c01,
        a * a * xx + 2 * a * c * xy + c * c * yy,
        a * b * xy + b * c * yy,
        b * b * yy,
    )


@kernel
def _equations(rows, degree, square, moments, system):
    """Set the normal equations, the highest monomial first, without the constant."""
    sum_moments(rows, 0, 2 * degree, moments)
    p, last = len(system), terms(degree) - 1
    for i in range(p):
        for k in range(p // LANES * LANES, system.shape[1]):
            system[i, k] = 0.0
        g = last - i
        for k in range(i, p):
            h = last - k
            by_slopes = BY_X[g, h] * moments[PLACE_X[g, h]] + BY_Y[g, h] * moments[PLACE_Y[g, h]]
            system[i, k] = moments[PRODUCT[g, h]] + square * by_slopes
        for k in range(i):
            system[i, k] = 0.0
    at = 1
    for s in range(1, degree + 1):
        for j in range(s + 1):
            height = dot(rows, ONE + at, ONE + p + 3)
            slope = 0.0
            if s > j:
                slope += (s - j) * dot(rows, ONE + at - s, SLOPES)
            if j > 0:
                slope += j * dot(rows, ONE + at - s - 1, SLOPES + 1)
            system[last - at, p] = height + square * slope
            at += 1


@kernel
def _inverse(system, room, space):
    """Set room[k], k < p, to the last five columns of the inverse of a matrix that `solve`
    factorised: lane f belongs to its column p - 1 - f, the last coefficient."""
    p, width = system.shape
    for k in range(p):
        for f in range(LANES):
            room[k, f] = 0.0
    # Forward: columns of the unit matrix have their one in the last five rows.
    for i in range(p - 5, p):
        room[i, p - 1 - i] = 1.0
        for k in range(p - 5, i):
            factor = system[k, i] / system[k, k]
            for f in range(LANES):
                room[i, f] -= factor * room[k, f]
    for k in range(p - 1, -1, -1):
        right = part(space, SYSTEM + k * width + k + 1, (p - 1 - k,))
        substitute(room, k, p - 1 - k, right)
        inverse = 1 / system[k, k]
        for f in range(LANES):
            room[k, f] *= inverse


@kernel
def _by_slopes(rows, degree, square, room, space):
    """Set five rows to the derivatives of c10, c01, c20, c11 and c02 by the first slope, and five
    to those by the second."""
    p, below = len(room), terms(degree - 1)
    end = SYSTEM + p * (room.shape[1] + (p + LANES) // LANES * LANES)
    by_first = part(space, end, (below, LANES))
    by_second = part(space, end + below * LANES, (below, LANES))
    at = 0
    for s in range(degree):
        for j in range(s + 1):
            # x times the monomial is s + 1 places behind it, y times it one more.
            x, y = square * (s + 1 - j), square * (j + 1)
            for f in range(LANES):
                by_first[at, f] = x * room[p - 1 - (at + s), f]
                by_second[at, f] = y * room[p - 1 - (at + s + 1), f]
            at += 1
    combine(rows, FUNCTIONALS, 5, ONE, below, by_first)
    combine(rows, FUNCTIONALS + 5, 5, ONE, below, by_second)


@kernel
def _to_normals(rows, normals, count, N, U, V, axes):
    """Turn derivatives of whitened coefficients by whitened slopes to those of p, q, r, s and t by
    changes of normals; return the gain."""
    gain, over_u, over_v = 0.0, cross(N, U), cross(N, V)
    for i in range(count):
        m = normals[0, 1 + i], normals[1, 1 + i], normals[2, 1 + i]
        Xi, Yi = tangents(m)
        height = along(m, N)
        steep = 1 / (height * height)
        uu, uv = steep * along(Yi, over_u), -steep * along(Xi, over_u)
        vu, vv = steep * along(Yi, over_v), -steep * along(Xi, over_v)
        g, h = FUNCTIONALS, FUNCTIONALS + 5
        square = rows[g, i] * rows[g, i] + rows[g + 1, i] * rows[g + 1, i]
        square += rows[h, i] * rows[h, i] + rows[h + 1, i] * rows[h + 1, i]
        # A slope changes by 1 / cos^2 of the change of its angle.
        gain += square * steep * steep
        by_u = _derivatives(*_by_normal(rows, i, uu, vu), axes)
        by_v = _derivatives(*_by_normal(rows, i, uv, vv), axes)
        for k in range(5):
            rows[g + 2 * k, i], rows[g + 2 * k + 1, i] = by_u[k], by_v[k]
    return np.sqrt(gain)


@kernel
def _by_normal(rows, i, x, y):
    """Five derivatives by slopes that change by x and y."""
    g, h = FUNCTIONALS, FUNCTIONALS + 5
    return (
        rows[g, i] * x + rows[h, i] * y,
        rows[g + 1, i] * x + rows[h + 1, i] * y,
        rows[g + 2, i] * x + rows[h + 2, i] * y,
        rows[g + 3, i] * x + rows[h + 3, i] * y,
        rows[g + 4, i] * x + rows[h + 4, i] * y,
    )
