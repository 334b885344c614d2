"""Polynomials over more and more rings of one disk, in one frame; how a sample of them changes with
the scale."""

from typing import Literal

import numpy as np

from .compiled import kernel
from .disk import SPACE
from .fit import CUTOFF
from .parts import part
from .polynomial import fit_polynomial
from .tensor import from_graph
from .vectors import at, tangents

# By degree.
RINGS = {4: (3, 4, 5, 6, 8, 10, 13), 6: (3, 4, 5, 6, 8)}
MOST = max(map(len, RINGS.values()))
OVER = np.array([[*RINGS[degree], *[0] * MOST][:MOST] for degree in (4, 6)])
FORMS = SPACE - 24  # place in Disk.space, behind what `fit_polynomial` needs


@kernel
def forms(disk, degree: Literal[6, 4] = 6, rings: Literal[8, 13] = 8):
    """f_xx, f_xy and f_yy of polynomials with a constant over each of RINGS[degree] of a `disk`, of
    which `rings` is the last; NaN where there are not so many, and behind the last. Before them,
    for degree 6, half of f_xx + f_yy of a polynomial through the vertex, over three rings with
    weights exp(-(hop / 3)^2)."""
    X, Y, N = _frame(disk)
    found = part(disk.space, FORMS, (3, MOST))
    through = np.nan
    # One call of the fit, so that it is compiled once; the last is that through the vertex.
    for j in range(MOST + 1):
        there = reach = 0
        if j < MOST:
            reach = OVER[degree // 2 - 2, j]
            # The same neighbours again would look like a fit that stands still.
            there = reach > 0 and disk.hops[disk.count - 1] >= reach
            _within(disk, reach)
        elif degree == 6:
            there = True
            for i in range(disk.count):
                hop = disk.hops[i]
                disk.weights[i] = np.exp(-((hop / 3) ** 2)) if hop <= 3 else 0.0
        if there:
            d, _ = fit_polynomial(disk, X, Y, N, 1 if j == MOST else 0, degree, CUTOFF)
            if j == MOST:
                through = (d[2] + d[4]) / 2
            else:
                found[0, j], found[1, j], found[2, j] = d[2], d[3], d[4]
        elif j < MOST:
            found[0, j], found[1, j], found[2, j] = np.nan, np.nan, np.nan
    f = found
    return (through, *at(f, 0), *at(f, 1), *at(f, 2), *at(f, 3), *at(f, 4), *at(f, 5), *at(f, 6))


@kernel
def _frame(disk):
    """The normal of a polynomial of degree 2 over two rings, with tangents."""
    N = disk.normal
    X, Y = tangents(N)
    _within(disk, 2)
    derivatives, _ = fit_polynomial(disk, X, Y, N, 0, 2, CUTOFF)
    _, N = from_graph(*derivatives, X, Y, N)
    return (*tangents(N), N)


@kernel
def _within(disk, rings):
    """Set the weights of a disk to 1 within some rings, else to 0."""
    for i in range(disk.count):
        disk.weights[i] = 1.0 if disk.hops[i] <= rings else 0.0


def nearest(points, sample, count):
    """The places of a sample that are nearest to points.

    Parameters
    ----------
    points : (m, 3)
    sample : (k, 3)
        Some of the points, or all.
    count : int
        How many are wanted where the sample is all of the points.

    Returns
    -------
    (m, n) int
        n is as many as there are of `count` points.
    """
    distances = sum((x[:, None] - y) ** 2 for x, y in zip(points.T, sample.T))
    n = max(1, min(count, len(points)) * len(sample) // len(points))
    return np.argpartition(distances, n - 1, axis=1)[:, :n]


def means(squares, near, outliers):
    """Trimmed means of squares over groups of a sample, and over all of it.

    Parameters
    ----------
    squares : (k,)
    near : (m, n) int
        The groups.
    outliers : float
        The part of the largest that is left out.

    Returns
    -------
    (m + 1,)
        Infinite where no square is finite.
    """
    return np.concatenate([_trimmed(squares[near], outliers), _trimmed(squares[None], outliers)])


def _trimmed(squares, outliers):
    x = np.sort(squares, axis=1)
    count = np.isfinite(x).sum(1)
    kept = count - (outliers * count).astype(int)
    total = np.where(np.arange(x.shape[1]) < kept[:, None], x, 0).sum(1)
    return np.where(kept > 0, total / np.maximum(kept, 1), np.inf)


def ratios(a, b, near):
    """Ratios of the median absolute values of a and b over groups of a sample, and over all of it.

    Parameters
    ----------
    a, b : (k,)
        NaN counts as 0.
    near : (m, n) int
        The groups.

    Returns
    -------
    (m + 1,)
    """
    groups, a, b = (near, np.arange(len(a))[None]), *np.nan_to_num(np.abs((a, b)))
    return np.concatenate([np.median(a[g], 1) / np.median(b[g], 1) for g in groups])
