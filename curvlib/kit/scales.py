"""Polynomials over more and more rings of one disk, in one frame; how a sample of them changes with
the scale."""

from typing import Literal

import numpy as np

from .compiled import kernel
from .disk import SPACE
from .parts import part
from .polynomial import fit_polynomial
from .tensor import from_graph
from .vectors import at, tangents

# By degree.
RINGS = {4: (3, 4, 5, 6, 8, 10, 13), 6: (3, 4, 5, 6, 8)}
OF_FOUR, OF_SIX = RINGS[4], RINGS[6]
FORMS = SPACE - 24  # place in Disk.space, behind what `fit_polynomial` needs


@kernel
def sextic(disk, rings: Literal[8] = 8):
    """Half of f_xx + f_yy of a polynomial of degree 6 through the vertex, over three rings with
    weights exp(-(hop / 3)^2); and f_xx, f_xy and f_yy of polynomials with a constant over each of
    RINGS[6] of a `disk`, of which `rings` is the last. NaN where there are not so many."""
    X, Y, N = _frame(disk)
    f = part(disk.space, FORMS, (3, len(OF_SIX)))
    _set_forms(disk, X, Y, N, 6, OF_SIX, f)
    for i in range(disk.count):
        hop = disk.hops[i]
        disk.weights[i] = np.exp(-((hop / 3) ** 2)) if hop <= 3 else 0.0
    d, _ = fit_polynomial(disk, X, Y, N, 1, 6)
    return ((d[2] + d[4]) / 2, *at(f, 0), *at(f, 1), *at(f, 2), *at(f, 3), *at(f, 4))


@kernel
def quartic(disk, rings: Literal[13] = 13):
    """f_xx, f_xy and f_yy of polynomials of degree 4 over each of RINGS[4] of a `disk`;
    `rings` is the last. NaN where there are not so many."""
    X, Y, N = _frame(disk)
    f = part(disk.space, FORMS, (3, len(OF_FOUR)))
    _set_forms(disk, X, Y, N, 4, OF_FOUR, f)
    return (*at(f, 0), *at(f, 1), *at(f, 2), *at(f, 3), *at(f, 4), *at(f, 5), *at(f, 6))


@kernel
def _frame(disk):
    """The normal of a polynomial of degree 2 over two rings, with tangents."""
    N = disk.normal
    X, Y = tangents(N)
    _within(disk, 2)
    derivatives, _ = fit_polynomial(disk, X, Y, N, 0, 2)
    _, N = from_graph(*derivatives, X, Y, N)
    return (*tangents(N), N)


@kernel
def _set_forms(disk, X, Y, N, degree, scales, forms):
    """Set forms (3, n) to f_xx, f_xy and f_yy of polynomials over so many rings of a disk."""
    for j in range(len(scales)):
        _within(disk, scales[j])
        derivatives, _ = fit_polynomial(disk, X, Y, N, 0, degree)
        # The same neighbours again would look like a fit that stands still.
        there = 1.0 if disk.hops[disk.count - 1] >= scales[j] else np.nan
        for k in range(3):
            forms[k, j] = there * derivatives[2 + k]


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
