"""The control net of a NURBS surface, checked and clamped, and the topology of the surface.

Seams and poles are found on the surface, along the edges of its domain. Control points alone do not
determine them: weights count, and with unclamped knots the outer rows are not on the surface.
"""

from bisect import bisect_left, bisect_right
from itertools import pairwise

import numpy as np
from geomdl import abstract, helpers

from curvlib.errors import InputError

# Points closer than SAME times the size of the surface, plus ROUNDINGS times the rounding of the
# largest coordinate, are equal.
SAME = 1e-12
ROUNDINGS = 16
# Largest rounding of coordinates, relative to the size, that leaves curvature enough digits.
TOO_FAR = 1e-5


class Net:
    """A control net with end knots of full multiplicity, so that its outer rows are the control
    points of the surface's edges.

    `degrees` and `knots`: of u and of v. `points` (nu, nv, 3), `weights` (nu, nv, 1).
    `closed`: whether the two ends of u (of v) are the same curve. `poles`: the (axis, end),
    axis 0 for u and 1 for v, end 0 or -1, where that edge is a single point. `size`: the
    largest distance along an axis from the mean of the points. `near`: the distance within
    which points are the same. `rounding`: that of the coordinates, relative to `size`.

    Raises InputError for a model that is no complete geomdl surface, is trimmed or torn, or
    lies too far from the origin for its size.
    """

    def __init__(self, model, where: str):
        self.points, self.weights = _read(model, where)
        self.degrees = (model.degree_u, model.degree_v)
        self.knots = [[float(t) for t in k] for k in (model.knotvector_u, model.knotvector_v)]
        for axis in (0, 1):
            self._clamp(axis)
        self.size = float(np.abs(self.points - self.points.mean((0, 1))).max())
        reach = float(np.abs(self.points).max())
        rounding = ROUNDINGS * np.finfo(float).eps * reach
        if not rounding < TOO_FAR * self.size:
            raise InputError(
                f"{where}: coordinates of up to {reach:.3g} are rounded too much for a surface of "
                f"size {self.size:.3g}; move it to the origin"
            )
        self.near, self.rounding = SAME * self.size + rounding, rounding / self.size
        self.closed, self.poles = (), []
        for axis in (0, 1):
            self._find_edges(axis, where)

    def _clamp(self, axis):
        degree, knots, weights = self.degrees[axis], self.knots[axis], self.weights
        net = np.concatenate((self.points * weights, weights), -1).swapaxes(0, axis)
        for _ in range(2):
            end = knots[degree]
            while knots.count(end) < degree:
                knots, net = _insert(degree, knots, net, end)
            first = bisect_right(knots, end) - 1 - degree
            knots, net = [end, *knots[first + 1 :]], net[first:]
            # Reverse, for the other end; the second time this restores the order.
            knots, net = [-t for t in reversed(knots)], net[::-1]
        if knots != self.knots[axis]:
            net = net.swapaxes(0, axis)
            self.knots[axis], self.weights = knots, net[..., 3:]
            self.points = net[..., :3] / self.weights

    def _find_edges(self, axis, where):
        """Find seams and poles; raise InputError where the sides of a knot are different curves."""
        basis = _samples(self.degrees[1 - axis], self.knots[1 - axis])
        points, weights = (a.swapaxes(0, axis) for a in (self.points, self.weights))

        def curve(row):
            return (basis @ (points[row] * weights[row])) / (basis @ weights[row])

        def same(a, b):
            return bool(np.abs(a - b).max() <= self.near)

        degree, knots = self.degrees[axis], self.knots[axis]
        for t in sorted(set(knots[degree + 1 : -degree - 1])):
            below, above = bisect_left(knots, t) - 1, bisect_right(knots, t) - 1 - degree
            if below < above and not same(curve(below), curve(above)):
                raise InputError(f"{where} is torn along {'uv'[axis]} = {t!r}: cut it in two there")
        edges = {end: curve(end) for end in (0, -1)}
        self.closed += (same(edges[0], edges[-1]),)
        for end, edge in edges.items():
            if same(edge, edge[0]):
                self.poles.append((axis, end))
                # Equal to the last bit, so that S_u beside the pole has a small relative error.
                points[end] = points[end, 0]


def _read(model, where):
    """Points (nu, nv, 3) and weights (nu, nv, 1) of a geomdl surface."""
    if not isinstance(model, abstract.Surface):
        raise InputError(f"{where}: a geomdl surface is needed, not {type(model).__name__}")
    if model.trims:
        raise InputError(
            f"{where} has {len(model.trims)} trim curves: trimmed surfaces are not supported"
        )
    if not (model.ctrlpts_size and model.knotvector_u and model.knotvector_v):
        raise InputError(f"{where}: its control points or knots are not set")
    if model.dimension != 3:
        raise InputError(f"{where}: control points of dimension {model.dimension}, 3 is needed")
    net = np.reshape(
        model.ctrlptsw if model.rational else model.ctrlpts,
        (model.ctrlpts_size_u, model.ctrlpts_size_v, -1),
    )
    weights = net[..., 3:] if model.rational else np.ones((*net.shape[:2], 1))
    if not np.isfinite(net).all():
        raise InputError(f"{where}: a control point is not finite")
    if not (weights > 0).all():
        raise InputError(f"{where}: a weight is {weights.min():g}, weights have to be positive")
    return net[..., :3] / weights, weights


def _insert(degree, knots, net, t):
    """Insert a knot t by Boehm's algorithm."""
    span, count = bisect_right(knots, t) - 1, knots.count(t)
    i = np.arange(span - degree + 1, span - count + 1)
    start, end = np.take(knots, i), np.take(knots, i + degree)
    share = ((t - start) / (end - start))[:, None, None]
    new = (1 - share) * net[i - 1] + share * net[i]
    net = np.concatenate((net[: i[0]], new, net[i[-1] :]))
    return [*knots[: span + 1], t, *knots[span + 1 :]], net


def _samples(degree, knots):
    """The basis functions (m, n) at 2 degree + 1 points of each span: rational curves of that
    degree that agree there are equal on the span."""
    rows = []
    for low, high in pairwise(sorted(set(knots))):
        span = bisect_right(knots, low) - 1
        for t in np.linspace(low, high, 2 * degree + 1):
            row = np.zeros(len(knots) - degree - 1)
            row[span - degree : span + 1] = helpers.basis_function(degree, knots, span, float(t))
            rows.append(row)
    return np.array(rows)
