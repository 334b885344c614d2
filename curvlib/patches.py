"""Evaluation of a NURBS surface and its derivatives, span by span.

Every pair of knot spans is expanded once into the Taylor polynomial of the homogeneous net
about the centre of the spans, or about the pole where they touch one. Evaluation is then two
nested Horner schemes over arrays, one-sided by the choice of span, and made of + - * / alone:
the same bytes on every machine.
"""

import math
from bisect import bisect_right
from itertools import pairwise

import numpy as np
from geomdl import helpers

CHUNK = 2048


class Patches:
    """The polynomial pieces of a geomdl NURBS surface, and what its net tells.

    `breaks`: the distinct knots inside the domain, ends included, for u and for v.
    `closed`: whether the two ends of u (of v) meet in a seam. `poles`: the (axis, end), axis 0
    for u and 1 for v, end 0 or -1, where that line of the domain's edge is a single point.
    `size`: the largest distance along an axis from the net's centre.
    """

    def __init__(self, model):
        net = np.reshape(model.ctrlpts, (model.ctrlpts_size_u, model.ctrlpts_size_v, 3))
        weights = np.reshape(model.weights, net.shape[:2])[..., None]
        self.size = float(np.abs(net - net.mean((0, 1))).max())
        near = 1e-12 * self.size
        lines = (net, net.swapaxes(0, 1))
        self.closed = tuple(bool(np.abs(p[0] - p[-1]).max() <= near) for p in lines)
        self.poles = [
            (axis, end)
            for axis, p in enumerate(lines)
            for end in (0, -1)
            if np.abs(p[end] - p[end][0]).max() <= near
        ]
        low_u, high_u, low_v, high_v = (p in self.poles for p in ((0, 0), (0, -1), (1, 0), (1, -1)))
        breaks_u, pieces_u = _taylor(model.degree_u, model.knotvector_u, low_u, high_u)
        breaks_v, pieces_v = _taylor(model.degree_v, model.knotvector_v, low_v, high_v)
        self.breaks = (breaks_u, breaks_v)
        self._pieces = []
        for centre_u, i, basis_u in pieces_u:
            for centre_v, j, basis_v in pieces_v:
                # Measured from its own corner, so that next to a pole S - origin, and with it
                # S_u, is small with a small relative error.
                at = (slice(i, i + basis_u.shape[1]), slice(j, j + basis_v.shape[1]))
                ends = [
                    -1 if c == b[-1] else 0 for c, b in ((centre_u, breaks_u), (centre_v, breaks_v))
                ]
                origin = net[at][ends[0], ends[1]]
                local = np.concatenate(((net[at] - origin) * weights[at], weights[at]), -1)
                local = (basis_u[:, :, None, None] * local).sum(1)
                local = (basis_v[:, None, :, None] * local).sum(2)
                # (power of v, power of u, 4, 1): ready for Horner over arrays of points.
                self._pieces.append((centre_u, centre_v, local[..., None], origin[:, None]))

    def evaluate(self, u, v, span_u, span_v, order=2):
        """S, S_u, S_v, S_uu, S_uv, S_vv, shape (6, 3, m), of the given spans; order=0: S alone.

        u, v (m,) float, span_u, span_v (m,) int: a point on a knot has the value of the side
        whose span is named.
        """
        out = np.empty((6 if order else 1, 3, len(u)))
        piece = span_u * (len(self.breaks[1]) - 1) + span_v
        by_piece = np.argsort(piece, kind="stable")
        ends = np.searchsorted(piece[by_piece], np.arange(len(self._pieces) + 1))
        for k, (centre_u, centre_v, coefficients, origin) in enumerate(self._pieces):
            for start in range(ends[k], ends[k + 1], CHUNK):
                at = by_piece[start : min(start + CHUNK, ends[k + 1])]
                values = _homogeneous(coefficients, u[at] - centre_u, v[at] - centre_v, order)
                values = _dehomogenise(values)
                values[0] += origin
                out[:, :, at] = values
        return out


def _taylor(degree, knots, pole_low, pole_high):
    """Breaks (s + 1,) and per span (centre, index of its first basis function, Taylor
    coefficients of its basis functions about the centre (power, function)).

    Beside a pole the centre is the pole's end of the span.
    """
    knots = list(knots)
    breaks = sorted(set(knots[degree : len(knots) - degree]))
    if pole_low and pole_high and len(breaks) == 2:
        breaks.insert(1, (breaks[0] + breaks[1]) / 2)
    pieces = []
    for low, high in pairwise(breaks):
        centre = (low + high) / 2
        if pole_low and low == breaks[0]:
            centre = low
        elif pole_high and high == breaks[-1]:
            centre = high
        span = bisect_right(knots, low) - 1
        basis = helpers.basis_function_ders(degree, knots, span, centre, degree)
        taylor = np.array([np.array(row) / math.factorial(k) for k, row in enumerate(basis)])
        pieces.append((centre, span - degree, taylor))
    return np.array(breaks), pieces


def _horner(coefficients, x, order):
    """The polynomial and its first `order` derivatives at x; coefficients by rising power."""
    p = [coefficients[-1]] + [np.zeros_like(coefficients[-1])] * order
    for c in coefficients[-2::-1]:
        for k in range(order, 0, -1):
            p[k] = p[k] * x + p[k - 1]
        p[0] = p[0] * x + c
    return [factor * value for factor, value in zip((1, 1, 2), p)]


def _homogeneous(coefficients, x, y, order):
    """A = (w S, w), or with order=2 A, A_u, A_v, A_uu, A_uv, A_vv; each (4, m)."""
    if order == 0:
        (A,) = _horner(coefficients, y, 0)
        return _horner(A, x, 0)
    f, f_v, f_vv = _horner(coefficients, y, 2)
    A, A_u, A_uu = _horner(f, x, 2)
    A_v, A_uv = _horner(f_v, x, 1)
    (A_vv,) = _horner(f_vv, x, 0)
    return [A, A_u, A_v, A_uu, A_uv, A_vv]


def _dehomogenise(A):
    """Derivatives of S = A[:3] / A[3] from those of A: the product rule on A = w S, solved."""
    values, weights = [a[:3] for a in A], [a[3] for a in A]
    w = weights[0]
    S = values[0] / w
    if len(A) == 1:
        return [S]
    _, A_u, A_v, A_uu, A_uv, A_vv = values
    _, w_u, w_v, w_uu, w_uv, w_vv = weights
    S_u = (A_u - w_u * S) / w
    S_v = (A_v - w_v * S) / w
    S_uu = (A_uu - 2 * w_u * S_u - w_uu * S) / w
    S_uv = (A_uv - w_u * S_v - w_v * S_u - w_uv * S) / w
    S_vv = (A_vv - 2 * w_v * S_v - w_vv * S) / w
    return [S, S_u, S_v, S_uu, S_uv, S_vv]
