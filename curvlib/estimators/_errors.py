"""Standard errors of fits of some degree and scale: from residuals, and from neighbouring scales."""

from functools import lru_cache
from typing import Literal

import numpy as np

from curvlib.kit.compiled import kernel
from curvlib.kit.scales import RINGS
from curvlib.kit.tensor import from_graph
from curvlib.kit.variance import variances
from curvlib.kit.vectors import tangents

from . import ball_regression, compact_hermite, jet

NAMES = "K", "H", "k1", "k2"
# One of so many vertices has a second fit beside the first.
FEWER, FEWER_EXACT = 4, 8
# Sums over neighbours: of residuals, and of what second fits differ by.
SWEEPS, SWEEPS_BIAS = 2, 3
# Of vertices from the boundary, each of which is summed over alone.
LAYERS = 4
# The error of compact_hermite, and that of the jet through the vertex, over the mean difference
# from the jet of degree 6 by approximation.
EXACT = 0.5
EXACT_BESIDE = 1.0
THROUGH = 1.4
# Of the scale, that the bias of a form grows with.
POWER = {6: 4, 4: 3}
# Radii of balls, the larger over the smaller; ratios of radius and edge where variances are known.
NEXT = 2**0.5
LATTICE = np.geomspace(0.75, 24, 16)


class Errors:
    """Standard errors of K, H, k1 and k2 over a mesh, whose regions have fits of their own.

    Parameters
    ----------
    passes : Passes
    """

    def __init__(self, passes):
        count = len(passes.vertices)
        self._passes, self._random = passes, np.random.default_rng(0)
        self._residuals = np.zeros((2, count))  # sums of squares, and how many are free
        # Per variance of the vertices: of NAMES, and of what drives k1 and k2 apart.
        self._variances = np.zeros((5, count))
        self._layers, self._pairs = passes.layers(LAYERS), []

    def values(self, fit, vertices):
        """The values of a fit, as `Passes.estimates`; what it says of errors is kept."""
        if vertices is None:
            vertices = np.arange(len(self._passes.vertices), dtype=np.int32)
        return OF[fit.function](self, vertices, **fit.options)

    def standard(self, found):
        """Standard errors (4, V) of NAMES, whose values are in `found`: NaN where these are."""
        values = np.stack([found[name] for name in NAMES])
        squares, free = self._passes.sums(self._residuals, SWEEPS, self._layers)
        noise = np.divide(squares, free, out=np.zeros_like(free), where=free > 0)
        count = values.shape[1]
        biases = np.zeros((5, count))
        for vertices, differences, factor, own, other in self._pairs:
            excess = differences**2 - noise[vertices] * (own - other)
            biases[:4, vertices], biases[4, vertices] = factor * np.nan_to_num(excess), 1
        biases = self._passes.sums(biases, SWEEPS_BIAS, self._layers)
        bias = np.maximum(biases[:4], 0) / np.maximum(biases[4], 1e-300)
        variance = noise * self._variances[:4] + bias
        across = noise * self._variances[4]
        gap = (values[2] - values[3]) / 2
        variance[2:] += np.minimum(across, across**2 / np.maximum(4 * gap**2, 1e-300))
        return np.where(np.isfinite(values), np.sqrt(variance), np.nan)

    def _some(self, vertices, fewer):
        """A part of vertices, and all of those near a boundary."""
        chosen = self._random.random(len(vertices)) * fewer < 1
        return vertices[chosen | (self._layers[vertices] < LAYERS)]

    def _assessed(self, vertices, degree, rings):
        found = self._passes.field(assessed, vertices, degree=degree, rings=rings)
        return _Assessed(found if len(found) else np.full((17, len(vertices)), np.nan))

    def _keep(self, vertices, one):
        self._residuals[:, vertices] = np.where(one.residuals[1] > 0, one.residuals, 0)
        self._variances[:, vertices] = one.variances

    def _pair(self, vertices, differences, factor, own=0.0, other=0.0):
        self._pairs.append((vertices, differences, factor, own, other))

    def _jet(self, vertices, degree, rings, fit="interpolation"):
        through = fit == "interpolation"
        one = self._assessed(vertices, degree, rings)
        self._keep(vertices, one)
        wider = RINGS[degree][RINGS[degree].index(rings) + 1]
        chosen = np.searchsorted(vertices, some := self._some(vertices, FEWER))
        other = self._assessed(some, degree, wider)
        factor = 1 / ((wider / rings) ** POWER[degree] - 1) ** 2
        differences = other.values - one.values[:, chosen]
        self._pair(
            some, differences, factor, one.variances[:4, chosen], other.variances[:4]
        )
        if not through:
            return one.found
        self._variances[:, vertices] *= THROUGH**2
        return self._passes.estimates(jet.estimate, vertices, degree=degree, rings=rings)

    def _compact(self, vertices, degree):
        found = self._passes.estimates(compact_hermite.estimate, vertices, degree=degree)
        chosen = np.searchsorted(vertices, some := self._some(vertices, FEWER_EXACT))
        inner = self._layers[some] == LAYERS
        for rings, part, factor in ((3, inner, EXACT), (4, ~inner, EXACT_BESIDE)):
            other = self._assessed(some[part], 6, rings)
            self._pair(some[part], other.values - _of(found, len(vertices))[:, chosen[part]], factor**2)
        return found

    def _ball(self, vertices, radius):
        edges = float(radius.split()[0])
        found = self._passes.estimates(ball_regression.estimate, vertices, radius=radius)
        chosen = np.searchsorted(vertices, some := self._some(vertices, FEWER))
        self._residuals[:, some] = self._assessed(some, 6, 3).residuals
        other = self._passes.estimates(
            ball_regression.estimate, some, radius=f"{edges * NEXT} edges"
        )
        local = self._passes.edges()[vertices]
        length = edges * self._passes.mean_edge
        self._variances[:, vertices] = own = _of_balls(_of(found, len(vertices)), local, length)
        wider = _of_balls(_of(other, len(some)), local[chosen], length * NEXT)
        self._pair(some, _of(other, len(some)) - _of(found, len(vertices))[:, chosen], 1.0, own[:4, chosen], wider[:4])
        return found


OF = {
    jet.estimate: Errors._jet,
    compact_hermite.estimate: Errors._compact,
    ball_regression.estimate: Errors._ball,
}


def _of(found, count):
    """The values (4, m) of NAMES, NaN where nothing is `found`."""
    return np.stack([found.get(name, np.full(count, np.nan)) for name in NAMES])


class _Assessed:
    """Components of `assessed` by what they are."""

    def __init__(self, x):
        self.values, self.variances, self.residuals = x[:4], x[10:15], x[15:17]
        self.found = dict(zip(NAMES, x[:4])) | {"d1": x[4:7], "d2": x[7:10]}


@kernel
def assessed(disk, degree: Literal[4, 2, 3, 5, 6] = 4, rings: Literal[3, 2, 4, 5, 6, 8, 10, 13] = 3):
    """K, H, k1, k2, d1 and d2 of the jet by approximation that `jet` has, and `variances` of it."""
    N = disk.normal
    X, Y = tangents(N)
    f, reached, disk = jet.fit_jet(disk, X, Y, N, degree, rings, False)
    found, _ = from_graph(*f, X, Y, N)
    rest = variances(disk, f, found, degree, reached)
    return (found.K, found.H, found.k1, found.k2, *found.d1, *found.d2, *rest)


def _of_balls(values, edges, radius):
    """Variances (5, m) of `ball_regression` per variance of the heights, of balls of a radius on
    vertices whose edges have the lengths (m,), NAMES being `values`."""
    _, H, k1, k2 = values
    ratio = np.log(radius / edges)
    of_H, across = (
        np.exp(np.interp(ratio, np.log(LATTICE), np.log(x))) / edges**4 for x in _lattice()
    )
    k = of_H + across
    return np.stack([4 * H * H * of_H + (k1 - k2) ** 2 * across, of_H, k, k, across])


@lru_cache(maxsize=1)
def _lattice():
    """Variances of H, and of a form across a principal direction, by `ball_regression` on a plane
    of equilateral triangles of edge 1 with noise of variance 1, for the radii LATTICE: (2, n)."""
    return np.array([_on_lattice(radius) for radius in LATTICE]).T


def _on_lattice(radius):
    # Normals are linear in the heights: u_T = -grad z, averaged; so is the regression. It is
    # carried back, from weights of normals to weights of areas and of heights.
    steps = np.arange(-int(radius * 1.7 + 4), int(radius * 1.7 + 5))
    i, j = (x.ravel() for x in np.meshgrid(steps, steps, indexing="ij"))
    points = np.column_stack((i + j / 2, j * np.sqrt(0.75)))
    distance = np.hypot(*points.T)
    there = distance < max(radius, 1.01)
    x = points[there]
    weight = np.maximum(1 - (distance[there] / radius) ** 2, 0)
    inner = max(ball_regression.INNER * radius, 1e-9)
    size = len(steps)
    moment = (weight * x[:, 0] ** 2).sum()
    if moment == 0:
        weight = np.ones(len(x))
        moment = (x[:, 0] ** 2).sum()
    near = [
        (a, b, w)
        for a, b in zip(i, j)
        if (w := 1 - ((a + b / 2) ** 2 + 0.75 * b * b) / inner**2) > 0 or a == b == 0
    ]
    total = sum(w for _, _, w in near)
    found = []
    for turn in (np.eye(2), np.diag((1.0, -1.0))):
        # 2 H = a + c, and a - c.
        of_normals = np.zeros((2, size, size))
        at = np.flatnonzero(there)
        of_normals[:, at // size, at % size] = (weight * (turn @ x.T)) / moment / 2
        of_areas = sum(w / total * np.roll(of_normals, (a, b), (1, 2)) for a, b, w in near)
        # The gradient over the six triangles of a vertex: a sum over its neighbours along edges.
        of_heights = np.zeros((size, size))
        for a, b in ((1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)):
            e = a + b / 2, b * np.sqrt(0.75)
            of_heights -= np.roll((e[0] * of_areas[0] + e[1] * of_areas[1]) / 3, (a, b), (0, 1))
        found.append((of_heights**2).sum())
    return found
