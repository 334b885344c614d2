"""Polynomials over more and more rings of one disk, in one frame: their change with the scale."""

from typing import Literal

import numpy as np

from .compiled import kernel
from .polynomial import fit_polynomial
from .tensor import from_graph
from .vectors import tangents

# By degree.
RINGS = {4: (3, 4, 5, 6, 8, 10, 13), 6: (3, 4, 5, 6, 8)}


@kernel
def sextic(disk, rings: Literal[8] = 8):
    """Half of f_xx + f_yy of a polynomial of degree 6 through the vertex, over three rings with
    weights exp(-(hop / 3)^2); and f_xx, f_xy and f_yy of polynomials with a constant over each of
    RINGS[6] of a `disk`, of which `rings` is the last."""
    X, Y, N = _frame(disk)
    a, b, c = _over(disk, X, Y, N, 6, 3), _over(disk, X, Y, N, 6, 4), _over(disk, X, Y, N, 6, 5)
    d, e = _over(disk, X, Y, N, 6, 6), _over(disk, X, Y, N, 6, 8)
    for i in range(disk.count):
        hop = disk.hops[i]
        disk.weights[i] = np.exp(-((hop / 3) ** 2)) if hop <= 3 else 0.0
    f, _ = fit_polynomial(disk, X, Y, N, 1, 6)
    return ((f[2] + f[4]) / 2, *a, *b, *c, *d, *e)


@kernel
def quartic(disk, rings: Literal[13] = 13):
    """f_xx, f_xy and f_yy of polynomials of degree 4 over each of RINGS[4] of a `disk`;
    `rings` is the last."""
    X, Y, N = _frame(disk)
    a, b, c = _over(disk, X, Y, N, 4, 3), _over(disk, X, Y, N, 4, 4), _over(disk, X, Y, N, 4, 5)
    d, e, f = _over(disk, X, Y, N, 4, 6), _over(disk, X, Y, N, 4, 8), _over(disk, X, Y, N, 4, 10)
    return (*a, *b, *c, *d, *e, *f, *_over(disk, X, Y, N, 4, 13))


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
def _over(disk, X, Y, N, degree, rings):
    """f_xx, f_xy and f_yy of a polynomial over some rings of a disk."""
    _within(disk, rings)
    derivatives, _ = fit_polynomial(disk, X, Y, N, 0, degree)
    return derivatives[2], derivatives[3], derivatives[4]


@kernel
def _within(disk, rings):
    """Set the weights of a disk to 1 within some rings, else to 0."""
    for i in range(disk.count):
        disk.weights[i] = 1.0 if disk.hops[i] <= rings else 0.0
