"""A NURBS surface as polynomials, span by span.

Every pair of knot spans is expanded once into the Taylor polynomial of the homogeneous net
about the centre of the spans, or about the pole where they touch one.
"""

import math
from bisect import bisect_right
from collections import namedtuple
from itertools import pairwise

import numpy as np
from geomdl import helpers

Pieces = namedtuple("Pieces", "breaks_u breaks_v centres_u centres_v coefficients origins")
Pieces.__doc__ = """The polynomials of a surface, as compiled code takes them.

`breaks_u` (spans + 1,), `centres_u` (spans,): where the spans of u end, and the parameter that
their polynomials are about; of v likewise. `coefficients` (spans of u, spans of v, powers of u,
powers of v, 4): of w (S - origin) and w. `origins` (spans of u, spans of v, 3).
"""


class Patches:
    """The polynomial pieces of a geomdl NURBS surface, and what its net tells.

    `breaks`: the distinct knots inside the domain, ends included, for u and for v.
    `closed`: whether the two ends of u (of v) meet in a seam. `poles`: the (axis, end), axis 0
    for u and 1 for v, end 0 or -1, where that line of the domain's edge is a single point.
    `size`: the largest distance along an axis from the net's centre. `pieces`: the polynomials.
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
        shape = len(pieces_u), len(pieces_v)
        powers = model.degree_u + 1, model.degree_v + 1
        self.pieces = Pieces(
            *self.breaks,
            np.array([centre for centre, _, _ in pieces_u]),
            np.array([centre for centre, _, _ in pieces_v]),
            np.empty((*shape, *powers, 4)),
            np.empty((*shape, 3)),
        )
        for s, (centre_u, i, basis_u) in enumerate(pieces_u):
            for t, (centre_v, j, basis_v) in enumerate(pieces_v):
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
                self.pieces.coefficients[s, t] = local.swapaxes(0, 1)
                self.pieces.origins[s, t] = origin


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
