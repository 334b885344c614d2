"""A quadric near most neighbours: consensus of samples, then an M-estimate."""

from typing import Literal

import numpy as np

from curvlib.kit.compiled import kernel
from curvlib.kit.disk import Disk
from curvlib.kit.disk import normals as normals
from curvlib.kit.parts import part
from curvlib.kit.polynomial import monomials
from curvlib.kit.reweighted import (
    RESIDUAL,
    UNKNOWNS,
    WEIGHT,
    consistency,
    fit_absolute,
    fit_biweight,
    fit_weighted,
    median_normal,
    scale,
    set_biweights,
    set_residuals,
    weigh_by_distance,
)
from curvlib.kit.tensor import from_graph
from curvlib.kit.vectors import add, divide, norm, tangents

LABEL = "Robust quadric"
SOURCE = "https://doi.org/10.1214/aos/1176350366"
STYLE = {"color": "#999933", "marker": "*", "linestyle": "-"}

INDEX = 26  # a row behind those of the fit
# Residuals of more scales than this have no weight: 95 % efficient under Gaussian noise. The last
# fit has room for residuals of a smooth surface, which are no noise.
TUNING, LAST = 4.685, 8.0
SAMPLES = 100
# Scales in units of the disk's size. Up to the one, with no residual that is large beside it, there
# is no other quadric to search for; above the other, no quadric is near most neighbours.
SMALL, LARGE = 0.005, 0.3


@kernel
def estimate(disk, normals, rings: Literal[2, 1, 3] = 2):
    """All of K, H, k1, k2, d1 and d2 of z = a + b x + c y + d x^2 + e x y + f y^2, an MM-estimate:
    the quadric that is near most neighbours, fitted to those near it and to the vertex.

    There are two starts, in a frame with the median of the normals: the fit of the least absolute
    residuals; and, where some neighbours are far from that, of the quadrics through 100 samples of
    six neighbours the one with the smallest scale of residuals. Both are fitted with Tukey's
    biweight until they stand still. The one that ends with the smaller scale is fitted once more,
    with z along its normal.

    Parameters
    ----------
    disk : Disk
        A vertex and its neighbours.
    normals : (3, 1 + n)
        Unit normals of the vertex and its neighbours, weighted by area.
    rings : {2, 1, 3}
        How many rings of neighbours.

    Returns
    -------
    Curvatures
        Pointwise, in 1/length^2 and 1/length, positive where the surface bends away from its
        normal; d1 and d2 are NaN at an umbilic. A vertex that is itself displaced has the values of
        its neighbours' quadric below or above it. NaN: needs a disk or half-disk of triangles, and
        a quadric that is determined by the points near it: five neighbours and the vertex, not on a
        conic; with residuals of a scale of at most 0.3 of the disk's size, its rings times the
        median length of its edges. Vertices on a boundary have values, of the same order.

    Notes
    -----
    The scale is a quantile of the residuals that half of the neighbours and two reach: of 18
    neighbours over two rings about seven may lie anywhere. Measured on jittered tori, spheres and
    ellipsoids with 600 to 2,500 vertices, some of them displaced by one to four edges in random
    directions: of the other vertices this part has k1 or k2, about 1, off by more than 0.5.

    =================================== ====== ====== ====== ======
    displaced                              5 %   10 %   20 %   30 %
    =================================== ====== ====== ====== ======
    this fit over two rings             0.04 %  0.2 %    2 %   10 %
    this fit over three rings           0.01 %    0 %  0.4 %    4 %
    normals: M-estimate                    5 %   20 %   55 %   74 %
    normals, robust ones: M-estimate     0.2 %  0.8 %   10 %   32 %
    jet of degree 2: least squares        46 %   71 %   88 %   91 %
    =================================== ====== ====== ====== ======

    Vertices without a value are not in these parts: over two rings with 20 and 30 % displaced there
    are another 0.7 and 6 % of them. Displaced along the normals, 30 % spoil twice as many. Where
    edges are up to four times as long one way as the other, on a torus, it is 1 % with 10 %
    displaced. The M-estimate on normals with Geman-McClure's weights follows Kalogerakis, Simari,
    Nowrouzezahrai and Singh (2007), with the normal at the vertex as unknown. A displaced vertex
    turns the normals of all its neighbours, most of them where a tenth is displaced; robust ones
    are medians of those of a vertex's triangles. Under Gaussian noise normals are the better data:
    at 5 % of an edge their errors are half of those of the fits of positions.

    Without displaced vertices it is about the jet of degree 2, with 1.04 times its mean error of K
    and 1.02 times that of H, and under that noise 1.06 and 1.04 times.

    Order: O(h) on any mesh that determines the quadric, as for the jet of degree 2, whose fit it is
    but for weights between 0 and 1 (Cazals and Pouget 2005); O(h^2) where neighbours lie
    symmetrically about the vertex.

    Source: Yohai (1987), High breakdown-point and high efficiency robust estimates for regression;
    Rousseeuw (1984), Least median of squares regression, for the second start.
    """
    e, weights, hops, distances, normal, exact, area, closed, _, count, rows, space, walk = disk
    size, factor = weigh_by_distance(disk), consistency(count)
    own = normal, exact, area, closed, size, count, rows, space, walk
    sized = Disk(e, weights, hops, distances, *own)
    quadric, other = part(space, 88, (UNKNOWNS + 1,)), part(space, 96, (UNKNOWNS + 1,))
    N = median_normal(disk, normals)
    X, Y = tangents(N)
    monomials(sized, X, Y, N, 4)
    least = np.inf
    if fit_absolute(disk, quadric, factor):
        least = fit_biweight(disk, quadric, factor, TUNING)
    doubtful = least > SMALL or _farthest(disk) > LAST * least
    if doubtful and count > UNKNOWNS and _consensus(disk, other, factor):
        found = fit_biweight(disk, other, factor, TUNING)
        if found < least:
            least = found
            for i in range(UNKNOWNS):
                quadric[i] = other[i]
    set_residuals(disk, quadric)
    set_biweights(disk, quadric, TUNING * least)
    N = add(add(N, -quadric[1], X), -quadric[2], Y)
    N = divide(N, norm(N))
    X, Y = tangents(N)
    monomials(sized, X, Y, N, 4)
    least = fit_biweight(disk, quadric, factor, LAST) if fit_weighted(disk, quadric) else np.inf
    curved = (1 if least <= LARGE else np.nan) / size
    r, s, t = 2 * curved * quadric[3], curved * quadric[4], 2 * curved * quadric[5]
    return from_graph(quadric[1], quadric[2], r, s, t, X, Y, N)[0]


@kernel
def _farthest(disk):
    """The largest residual."""
    farthest = 0.0
    for i in range(disk.count):
        farthest = max(farthest, disk.rows[RESIDUAL, i])
    return farthest


@kernel
def _consensus(disk, quadric, factor):
    """Set the quadric of the smallest scale among those through samples of six neighbours, and its
    residuals; whether there is one.

    The samples are places in the order of the last residuals: they do not depend on how the mesh
    lists its vertices.
    """
    rows, count, best, random = disk.rows, disk.count, np.inf, 1
    sample = part(disk.space, 80, (UNKNOWNS + 1,))
    sample[UNKNOWNS] = 0.0
    _sort(rows, count)
    for _ in range(SAMPLES):
        for i in range(len(disk.weights)):
            rows[WEIGHT, i] = 0.0
        for i in range(UNKNOWNS):
            # Source: Park, Miller, Stockmeyer (1993), Technical correspondence (CACM 36, 7).
            random = random * 48271 % 2147483647
            j = i + random % (count - i)
            rows[INDEX, i], rows[INDEX, j] = rows[INDEX, j], rows[INDEX, i]
            rows[WEIGHT, int(rows[INDEX, i])] = 1.0
        if fit_weighted(disk, sample):
            found = scale(disk, factor)
            if found < best:
                best = found
                for i in range(UNKNOWNS):
                    quadric[i] = sample[i]
    if best < np.inf:
        set_residuals(disk, quadric)
    return best < np.inf


@kernel
def _sort(rows, count):
    """Set row INDEX to the neighbours in the order of their residuals, by Shell's method."""
    for i in range(count):
        rows[INDEX, i] = i
    gap = count // 2
    while gap > 0:
        for i in range(gap, count):
            index, j = rows[INDEX, i], i
            residual = rows[RESIDUAL, int(index)]
            while j >= gap and rows[RESIDUAL, int(rows[INDEX, j - gap])] > residual:
                rows[INDEX, j] = rows[INDEX, j - gap]
                j -= gap
            rows[INDEX, j] = index
        gap //= 2
