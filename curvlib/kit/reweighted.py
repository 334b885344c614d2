"""A quadric z = f(x, y) near most points of a disk, by least squares with weights that change.

In all functions `disk` is a Disk of which `monomials` has set the rows up to degree 4. `quadric`
(7,) holds the six coefficients of f in their order, then the weight of the vertex itself, a point
at the origin. `factor` is that of `consistency`; `own`, 1 or 0, the largest weight of the vertex.
"""

import numpy as np

from .compiled import kernel
from .lanes import dot, multiply
from .parts import part
from .polynomial import set_matrix, solve
from .vectors import add, divide, norm

UNKNOWNS, MOMENTS = 6, 15
# Rows behind those of `monomials`: weights by distance, weights of the fit, heights times these,
# absolute residuals, room for the search of a quantile.
ONE, HEIGHT, NEAR, WEIGHT, WEIGHTED, RESIDUAL, SORTED = 3, 20, 21, 22, 23, 24, 25
# The scale of residuals is at least this, in the unit of the rows: a part of a grid may lie on a
# quadric but for rounding, also to float32.
LEAST = 1e-6
# Points on two parallel lines, or on two that cross, determine by rounding alone how a quadric
# bends between them. Its slope changes by at most this over the standard deviation of the points,
# lengths being in the unit of the rows.
BENT = 2.0
ABSOLUTE, ROUNDS = 6, 20  # the most fits with new weights; most quadrics stand still after ten


@kernel
def weigh_by_distance(disk):
    """Set weights that are 1 up to 1.5 median edges for each hop, and behind fall with the fourth
    power of the distance: a vertex far away would decide a fit.

    Returns
    -------
    float
        The size of the disk, median edges times rings, which a vertex far away does not change.
    """
    rows, count, rings = disk.rows, disk.count, 0
    for i in range(count):
        square = disk.e[0, i] ** 2 + disk.e[1, i] ** 2 + disk.e[2, i] ** 2
        rows[NEAR, i] = rows[SORTED, i] = np.sqrt(square) / disk.hops[i]
        rings = max(rings, disk.hops[i])
    edge = _smallest(rows, count, count // 2)
    for i in range(len(disk.weights)):
        ratio = min(1.0, 1.5 * edge / rows[NEAR, i]) if i < count else 0.0
        rows[NEAR, i] = ratio**4
    return edge * rings


@kernel
def consistency(count):
    """The factor that makes the quantile of `scale` the standard deviation of Gaussian residuals.

    Parameters
    ----------
    count : int
        Number of neighbours.

    Returns
    -------
    float

    Notes
    -----
    Sources: Schmeiser (1979) for quantiles of the normal distribution; Rousseeuw and Leroy (1987),
    section 5.1, for few points.
    """
    quantile = (1 + _most(count) / (count + 1)) / 2
    deviations = (quantile**0.135 - (1 - quantile) ** 0.135) / 0.1975
    return (1 + 5 / max(count + 1 - UNKNOWNS, 1)) / deviations


@kernel
def _most(count):
    return min((count + 5) // 2, count)


@kernel
def fit_weighted(disk, quadric):
    """Fit the quadric by least squares with the weights of row WEIGHT, and set its residuals.

    Returns
    -------
    bool
        Whether it is determined, as in `solve`, and turns by no more than BENT over the points;
        else nothing is changed.
    """
    rows, space, last = disk.rows, disk.space, UNKNOWNS - 1
    multiply(rows, WEIGHTED, WEIGHT, HEIGHT)
    moments, work = part(space, 0, (MOMENTS,)), part(space, 16, (2 * UNKNOWNS,))
    system = part(space, 32, (UNKNOWNS, 8))
    for k in range(MOMENTS):
        moments[k] = dot(rows, WEIGHT, ONE + k)
    moments[0] += quadric[UNKNOWNS]
    set_matrix(system, moments, last)
    for i in range(UNKNOWNS):
        system[i, UNKNOWNS] = dot(rows, WEIGHTED, ONE + last - i)
    determined = solve(system, UNKNOWNS, work) and _bend(system, moments) <= BENT
    if determined:
        for i in range(UNKNOWNS):
            quadric[i] = system[last - i, UNKNOWNS]
        set_residuals(disk, quadric)
    return determined


@kernel
def _bend(system, moments):
    """The largest second derivative of a solution, in coordinates in which the second moments of x
    and y are the unit matrix."""
    weight = moments[0]
    r, s, t = 2 * system[2, UNKNOWNS], system[1, UNKNOWNS], 2 * system[0, UNKNOWNS]
    xx, xy, yy = moments[3] / weight, moments[4] / weight, moments[5] / weight
    a = np.sqrt(xx)
    b = xy / a
    c = np.sqrt(max(yy - b * b, 0.0))
    of_uu, of_uv, of_vv = a * a * r + 2 * a * b * s + b * b * t, (a * s + b * t) * c, c * c * t
    return max(abs(of_uu), abs(of_uv), abs(of_vv))


@kernel
def set_residuals(disk, quadric):
    """Set the absolute residuals of the quadric at the neighbours."""
    rows = disk.rows
    c, x, y, xx, xy, yy = quadric[0], quadric[1], quadric[2], quadric[3], quadric[4], quadric[5]
    for i in range(len(disk.weights)):
        curved = xx * rows[ONE + 3, i] + xy * rows[ONE + 4, i] + yy * rows[ONE + 5, i]
        plane = c * rows[ONE, i] + x * rows[ONE + 1, i] + y * rows[ONE + 2, i]
        rows[RESIDUAL, i] = abs(rows[HEIGHT, i] - (plane + curved))


@kernel
def scale(disk, factor):
    """The scale of residuals: a quantile of their absolute values that half of the neighbours and
    two reach.

    Returns
    -------
    float
        In the unit of the rows, at least LEAST.
    """
    rows, count = disk.rows, disk.count
    for i in range(count):
        rows[SORTED, i] = rows[RESIDUAL, i]
    return max(factor * _smallest(rows, count, _most(count) - 1), LEAST)


@kernel
def _smallest(rows, count, k):
    """The k-th smallest number, from 0, of the first `count` of row SORTED, which is reordered.

    Source: Hoare (1961), Algorithm 65: Find.
    """
    low, high, row = 0, count - 1, SORTED
    while low < high:
        pivot, i, j = rows[row, (low + high) // 2], low, high
        while i <= j:
            while rows[row, i] < pivot:
                i += 1
            while rows[row, j] > pivot:
                j -= 1
            if i <= j:
                rows[row, i], rows[row, j] = rows[row, j], rows[row, i]
                i, j = i + 1, j - 1
        if k <= j:
            high = j
        elif k >= i:
            low = i
        else:
            break
    return rows[row, k]


@kernel
def fit_absolute(disk, quadric, factor, own=1.0):
    """Fit the quadric of about the least sum of absolute residuals, times weights by distance.

    Returns
    -------
    bool
        Whether it is determined.
    """
    rows, n, determined = disk.rows, len(disk.weights), True
    quadric[UNKNOWNS] = own
    for i in range(n):
        rows[WEIGHT, i] = rows[NEAR, i]
    for _ in range(ABSOLUTE):
        if determined:
            determined = fit_weighted(disk, quadric)
            least = 0.1 * scale(disk, factor)
            for i in range(n):
                rows[WEIGHT, i] = rows[NEAR, i] * least / max(rows[RESIDUAL, i], least)
            quadric[UNKNOWNS] = own * (least / max(abs(quadric[0]), least))
    return determined and fit_weighted(disk, quadric)


@kernel
def set_biweights(disk, quadric, limit, own=1.0):
    """Set weights of the fit to (1 - (r / limit)^2)^2 of the residuals r, 0 beyond the limit, times
    weights by distance.

    Parameters
    ----------
    disk, quadric
    limit : float
    own : float
    """
    rows, inverse = disk.rows, 1 / limit
    for i in range(len(disk.weights)):
        x = rows[RESIDUAL, i] * inverse
        y = max(0.0, 1 - x * x)
        rows[WEIGHT, i] = rows[NEAR, i] * (y * y)
    x = quadric[0] * inverse
    y = max(0.0, 1 - x * x)
    quadric[UNKNOWNS] = own * (y * y)


@kernel
def fit_biweight(disk, quadric, factor, tuning, own=1.0):
    """Fit with Tukey's biweight of the residuals until the quadric stands still.

    Parameters
    ----------
    disk, quadric, factor
    tuning : float
        The limit, in scales.
    own : float

    Returns
    -------
    float
        The scale; infinite where the weights left too few points to determine the quadric.
    """
    found = np.inf
    for _ in range(ROUNDS):
        found = scale(disk, factor)
        set_biweights(disk, quadric, tuning * found, own)
        xx, xy, yy = quadric[3], quadric[4], quadric[5]
        if not fit_weighted(disk, quadric):
            return np.inf
        change = abs(quadric[3] - xx) + abs(quadric[4] - xy) + abs(quadric[5] - yy)
        if change <= 1e-10 * (abs(xx) + abs(xy) + abs(yy)):
            break
    return found


@kernel
def median_normal(disk, normals):
    """The unit vector of about the least sum of distances from the normals of the vertices whose
    triangles lie in the disk, by Weiszfeld's iteration.

    Parameters
    ----------
    disk : Disk
    normals : (3 or more, 1 + n)
        At the vertex and its neighbours.

    Returns
    -------
    tuple of 3 floats
    """
    rings = disk.hops[disk.count - 1]
    N = (0.0, 0.0, 0.0)
    for _ in range(5):
        total = (0.0, 0.0, 0.0)
        for i in range(disk.count + 1):
            n = normals[0, i], normals[1, i], normals[2, i]
            if n[0] == n[0] and (i == 0 or disk.hops[i - 1] < rings):
                total = add(total, 1 / (0.1 + norm(add(n, -1.0, N))), n)
        N = divide(total, norm(total))
    return N
