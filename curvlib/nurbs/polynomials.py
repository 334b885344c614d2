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

Polynomials = namedtuple(
    "Polynomials", "breaks_u breaks_v centres_u centres_v coefficients origins"
)
Polynomials.__doc__ = """The polynomials of a surface, as compiled code takes them.

`breaks_u` (spans + 1,), `centres_u` (spans,): the ends of the spans of u, and the parameters about
which they are expanded; of v likewise. `coefficients` (spans of u, spans of v, powers of u,
powers of v, 4): of w (S - origin) and w. `origins` (spans of u, spans of v, 3).
"""


def expand(net) -> Polynomials:
    """The polynomials of a `Net`."""
    breaks, centres, bases = zip(*(_taylor(net, axis) for axis in (0, 1)))
    shape = tuple(map(len, centres))
    coefficients = np.empty((*shape, *(degree + 1 for degree in net.degrees), 4))
    origins = np.empty((*shape, 3))
    for s, (i, basis_u) in enumerate(bases[0]):
        for t, (j, basis_v) in enumerate(bases[1]):
            at = (slice(i, i + basis_u.shape[1]), slice(j, j + basis_v.shape[1]))
            points, weights = net.points[at], net.weights[at]
            # Relative to a corner of the span, the pole if there is one: next to it S - origin
            # and S_u are small, with a small relative error.
            corner = (-1 if c[k] == b[-1] else 0 for c, b, k in zip(centres, breaks, (s, t)))
            origin = points[tuple(corner)]
            local = np.concatenate(((points - origin) * weights, weights), -1)
            local = (basis_u[:, :, None, None] * local).sum(1)
            local = (basis_v[:, None, :, None] * local).sum(2)
            coefficients[s, t] = local.swapaxes(0, 1)
            origins[s, t] = origin
    return Polynomials(*breaks, *centres, coefficients, origins)


def _taylor(net, axis):
    """Breaks (spans + 1,), centres (spans,), and per span the index of its first basis function
    and the Taylor coefficients of its basis functions about the centre (power, function)."""
    degree, knots = net.degrees[axis], net.knots[axis]
    pole_low, pole_high = ((axis, end) in net.poles for end in (0, -1))
    breaks = sorted(set(knots))
    if pole_low and pole_high and len(breaks) == 2:
        breaks.insert(1, (breaks[0] + breaks[1]) / 2)
    centres, bases = [], []
    for low, high in pairwise(breaks):
        centre = (low + high) / 2
        if pole_low and low == breaks[0]:
            centre = low
        elif pole_high and high == breaks[-1]:
            centre = high
        span = bisect_right(knots, low) - 1
        basis = helpers.basis_function_ders(degree, knots, span, centre, degree)
        taylor = np.array([np.array(row) / math.factorial(k) for k, row in enumerate(basis)])
        centres.append(centre)
        bases.append((span - degree, taylor))
    return np.array(breaks), np.array(centres), bases
