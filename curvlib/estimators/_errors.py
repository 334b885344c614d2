"""Standard errors of what `adaptive_fit` takes: from residuals, and from a second fit beside it."""

from typing import Literal

import numpy as np

from curvlib.kit.compiled import kernel
from curvlib.kit.scales import RINGS
from curvlib.kit.tensor import from_graph
from curvlib.kit.variance import variances
from curvlib.kit.vectors import tangents

from . import _balls, ball_regression, compact_hermite, jet

NAMES = "K", "H", "k1", "k2"
# One of so many vertices has a second fit, of compact_hermite and of others; near a boundary all.
FEWER_EXACT, FEWER = 8, 4
# Sweeps of sums over neighbours, of residuals and of differences of two fits. Vertices so near a
# boundary are summed over with those alone that are as near: errors there are of another size.
SWEEPS, SWEEPS_BIAS, LAYERS = 2, 3, 4
# The error of compact_hermite over its difference from the jet of degree 6 by approximation over
# three rings; near a boundary, where it is a jet over three rings itself, over four.
EXACT, EXACT_BESIDE = 0.5, 1.0
# The error from noise of a jet through the vertex over that of one by approximation.
THROUGH = 1.4
# Of the scale, that bias is taken to grow with: of jets by degree, and of balls. Lower than in
# theory, which holds on finer meshes.
POWER, POWER_BALL = {6: 4, 4: 3}, 1.5
NEXT = 2**0.5  # the radius of the second ball over that of the first


class Errors:
    """Standard errors of K, H, k1 and k2 over a mesh whose regions have fits of their own.

    Parameters
    ----------
    passes : Passes

    Notes
    -----
    They are roots of s^2 c^T G^-1 c + b^2. For jets s^2 is the variance of the residuals, summed
    over two rings, and c^T G^-1 c that of `curvlib.kit.variance`. Residuals of ball_regression are
    correlated, since normals are means over balls, and are of bias first: s^2 is that of jets of
    degree 6 over three rings, and the variance per s^2 is that of `_balls`. b^2 is the mean square
    of the change to the next scale over three rings, less the part of noise in it, cut at 0, and
    extrapolated. Of compact_hermite it is all: part of the distance to a jet of degree 6.
    """

    def __init__(self, passes):
        count = len(passes.vertices)
        self._passes, self._random = passes, np.random.default_rng(0)
        self._layers = passes.layers(LAYERS)
        self._groups = self._layers.copy()  # that are summed over alone
        # Sums of squares of residuals, and how many of these are free.
        self._residuals = np.zeros((2, count))
        # Per variance of the vertices: of NAMES, and of a form across a principal direction.
        self._variances = np.zeros((5, count))
        self._pairs = []

    def values(self, fit, vertices):
        """The values of a fit, as `Passes.estimates` has them; what it says of errors is kept."""
        if vertices is None:
            vertices = np.arange(len(self._passes.vertices), dtype=np.int32)
        return OF[fit.function](self, vertices, **fit.options)

    def standard(self, found):
        """Standard errors (4, V) of the values `found` of NAMES, NaN where these are."""
        values, count = _of(found, 0), self._residuals.shape[1]
        noise = np.zeros(count)
        if self._residuals.any():
            squares, free = self._passes.sums(self._residuals, SWEEPS, self._groups)
            np.divide(squares, free, out=noise, where=free > 0)
        biases = np.zeros((5, count))
        for vertices, differences, factor, own, other in self._pairs:
            # Of two fits the smaller of which is nested in the larger, the difference has the
            # difference of the variances.
            excess = factor * (differences**2 - noise[vertices] * (own - other))
            known = np.isfinite(excess).all(0)
            biases[:4, vertices[known]], biases[4, vertices[known]] = excess[:, known], 1
        biases = self._passes.sums(biases, SWEEPS_BIAS, self._groups)
        biases[:, biases[4] == 0] = biases.sum(1)[:, None]
        variance = np.maximum(biases[:4], 0) / np.maximum(biases[4], 1)
        variance += noise * self._variances[:4]
        # Noise drives k1 and k2 apart by the second order, but at an umbilic by the first.
        across, gap = noise * self._variances[4], values[2] - values[3]
        variance[2:] += across * np.minimum(1, across / np.maximum(gap * gap, 1e-300))
        # Where neither is known, as of a few vertices apart from others: as elsewhere.
        for x in variance:
            positive = x[x > 0]
            x[x == 0] = np.median(positive) if len(positive) else 0
        return np.where(np.isfinite(values), np.sqrt(variance), np.nan)

    def _jet(self, vertices, degree, rings, fit="interpolation"):
        own = self._assessed(vertices, degree, rings)
        # As `jet` has them where it passes through the vertex; else they are those here.
        through = fit == "interpolation"
        larger = THROUGH**2 if through else 1.0
        self._residuals[:, vertices] = np.where(own.residuals[1] > 0, own.residuals, 0)
        self._variances[:, vertices] = larger * own.variances
        some, places = self._some(vertices, FEWER)
        wider = RINGS[degree][RINGS[degree].index(rings) + 1]
        other = self._assessed(some, degree, wider)
        self._pairs.append(
            (
                some,
                other.values - own.values[:, places],
                1 / ((wider / rings) ** POWER[degree] - 1) ** 2,
                own.variances[:4, places],
                other.variances[:4],
            )
        )
        if not through:
            return own.found
        return self._passes.estimates(jet.estimate, vertices, degree=degree, rings=rings)

    def _compact(self, vertices, degree):
        found = self._passes.estimates(compact_hermite.estimate, vertices, degree=degree)
        some, places = self._some(vertices, FEWER_EXACT)
        self._groups[vertices] += LAYERS + 1
        values, inner = _of(found, len(vertices))[:, places], self._layers[some] == LAYERS
        for part, rings, factor in ((inner, 3, EXACT), (~inner, 4, EXACT_BESIDE)):
            other = self._assessed(some[part], 6, rings).values
            self._pairs.append((some[part], other - values[:, part], factor**2, 0.0, 0.0))
        return found

    def _ball(self, vertices, radius):
        edges, count = float(radius.split()[0]), len(vertices)
        found = self._passes.estimates(ball_regression.estimate, vertices, radius=radius)
        some, places = self._some(vertices, FEWER)
        # Residuals of the regression are of its bias first.
        self._residuals[:, some] = np.nan_to_num(self._assessed(some, 6, 3).residuals)
        wider = f"{edges * NEXT} edges"
        other = self._passes.estimates(ball_regression.estimate, some, radius=wider)
        first, second = _of(found, count), _of(other, len(some))
        length, local = edges * self._passes.mean_edge, self._passes.edges()[vertices]
        own = _of_balls(first, *_balls.variances(local, length))
        apart = _of_balls(second, *_balls.variances(local[places], NEXT * length))
        self._variances[:, vertices] = own
        factor = 1 / (NEXT**POWER_BALL - 1) ** 2
        difference = second - first[:, places]
        self._pairs.append((some, difference, factor, own[:4, places], apart[:4]))
        return found

    def _some(self, vertices, fewer):
        """A part of vertices that has a second fit, and its places among them."""
        chosen = self._random.random(len(vertices)) * fewer < 1
        places = np.flatnonzero(chosen | (self._layers[vertices] < LAYERS))
        return vertices[places], places

    def _assessed(self, vertices, degree, rings):
        found = self._passes.field(assessed, vertices, degree=degree, rings=rings)
        return Parts(found if len(found) else np.full((17, len(vertices)), np.nan))


OF = {
    jet.estimate: Errors._jet,
    compact_hermite.estimate: Errors._compact,
    ball_regression.estimate: Errors._ball,
}


@kernel
def assessed(
    disk, degree: Literal[6, 4, 2, 3, 5] = 6, rings: Literal[3, 2, 4, 5, 6, 8, 10, 13] = 3
):
    """K, H, k1, k2, d1 and d2 of the jet of a `degree` by approximation over `rings` of a `disk`,
    as `jet` has them, and what `curvlib.kit.variance` knows of it."""
    N = disk.normal
    X, Y = tangents(N)
    f, reached, disk = jet.fit_jet(disk, X, Y, N, degree, rings, False)
    values, _ = from_graph(*f, X, Y, N)
    known = variances(disk, f, values, degree, reached)
    return (values.K, values.H, values.k1, values.k2, *values.d1, *values.d2, *known)


class Parts:
    """The components of `assessed` by what they are."""

    def __init__(self, x):
        self.values, self.variances, self.residuals = x[:4], x[10:15], x[15:]
        self.found = dict(zip(NAMES, x[:4])) | {"d1": x[4:7], "d2": x[7:10]}


def _of(found, count):
    """The values (4, m) of NAMES, NaN where nothing is `found`."""
    return np.stack([found.get(name, np.full(count, np.nan)) for name in NAMES])


def _of_balls(values, of_H, across):
    """Variances (5, m) of NAMES, and across, from those of H and of a form across a principal
    direction, in all of which noise is the same."""
    _, H, k1, k2 = values
    k = of_H + across
    return np.stack([4 * H * H * of_H + (k1 - k2) ** 2 * across, of_H, k, k, across])
