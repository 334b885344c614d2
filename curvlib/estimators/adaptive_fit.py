"""The fit and its scale that change least: chosen from the mesh itself."""

from typing import Literal

import numpy as np

from curvlib.kit.compiled import kernel
from curvlib.kit.displaced import displaced, placed, suspects
from curvlib.kit.polynomial import fit_polynomial
from curvlib.kit.tensor import Assessed, Choice, Curvatures, from_graph
from curvlib.kit.vectors import tangents

from . import ball_regression, jet

LABEL = "Adaptive fit"
SOURCE = "https://doi.org/10.1016/j.cagd.2004.09.004"
STYLE = {"color": "#000000", "marker": "P", "linestyle": "-"}
GLOBAL = "the choice is made for the whole mesh"

# Of searches for displaced vertices.
ROUNDS = 3
# Vertices on which the choice is made.
SAMPLE = 400
# By degree.
RINGS = {4: (3, 4, 5, 6, 8, 10, 13), 6: (3, 4, 5, 6, 8)}
RADII = 1.5, 2, 2.8, 4, 5.6, 8, 11, 16  # in mean edges
# The largest part of the sample, by change, that is left out of its mean.
OUTLIERS = 0.05
# The ratio of the difference of two fits of degree 6 to that of degrees 6 and 4 above which noise
# rules.
NOISE = 0.3
# The square of the error over the change, at the least change.
RISK, RISK_BALL = {6: 0.012, 4: 0.017}, 0.042


@kernel
def clean(disk, rings: Literal[3] = 3):
    """Half of f_xx + f_yy of three fits to a `disk` of three `rings`: of degree 6, through the
    vertex and with weights exp(-(hop / rings)^2), and with a constant; and of degree 4 with a
    constant."""
    N = disk.normal
    X, Y = tangents(N)
    six, _ = fit_polynomial(disk, X, Y, N, 0, 6)
    four, _ = fit_polynomial(disk, X, Y, N, 0, 4)
    for i in range(disk.count):
        disk.weights[i] = np.exp(-((disk.hops[i] / rings) ** 2))
    through, _ = fit_polynomial(disk, X, Y, N, 1, 6)
    return (
        (through[2] + through[4]) / 2,
        (six[2] + six[4]) / 2,
        (four[2] + four[4]) / 2,
    )


@kernel
def quartic(disk, rings: Literal[13] = 13):
    """f_xx, f_xy and f_yy of polynomials of degree 4 over each of RINGS[4] of a `disk`;
    `rings` is the last."""
    X, Y, N = _frame(disk)
    a, b, c = _over(disk, X, Y, N, 4, 3), _over(disk, X, Y, N, 4, 4), _over(disk, X, Y, N, 4, 5)
    d, e, f = _over(disk, X, Y, N, 4, 6), _over(disk, X, Y, N, 4, 8), _over(disk, X, Y, N, 4, 10)
    return (*a, *b, *c, *d, *e, *f, *_over(disk, X, Y, N, 4, 13))


@kernel
def sextic(disk, rings: Literal[8] = 8):
    """f_xx, f_xy and f_yy of polynomials of degree 6 over each of RINGS[6] of a `disk`;
    `rings` is the last."""
    X, Y, N = _frame(disk)
    a, b, c = _over(disk, X, Y, N, 6, 3), _over(disk, X, Y, N, 6, 4), _over(disk, X, Y, N, 6, 5)
    return (*a, *b, *c, *_over(disk, X, Y, N, 6, 6), *_over(disk, X, Y, N, 6, 8))


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


@kernel
def polynomial(disk, degree: Literal[4, 6] = 4, rings: Literal[3, 4, 5, 6, 8, 10] = 3):
    """Curvatures of a polynomial of some `degree` with a constant over the `rings` of a `disk`, in
    the frame of one of degree 2 over them."""
    N = disk.normal
    X, Y = tangents(N)
    derivatives, _ = fit_polynomial(disk, X, Y, N, 0, 2)
    _, N = from_graph(*derivatives, X, Y, N)
    X, Y = tangents(N)
    derivatives, _ = fit_polynomial(disk, X, Y, N, 0, degree)
    return from_graph(*derivatives, X, Y, N)[0]


def estimate(passes):
    """All of K, H, k1, k2, d1 and d2 of one of three fits, at one of several scales: that which
    changes least from scale to scale on a sample of vertices.

    Parameters
    ----------
    passes : Passes
        Over the mesh.

    Returns
    -------
    Assessed
        Pointwise, in 1/length^2 and 1/length, positive where the surface bends away from its
        normal; d1 and d2 are NaN at an umbilic. NaN: needs a disk or half-disk of triangles.
        Vertices on a boundary have values. `choice` is the call taken.

    Notes
    -----
    1. Two fits of degree 6 over three rings, one through the vertex and weighted, differ by noise
       more than by truncation: noise rules where the median of that difference is more than NOISE
       times the median difference from degree 4 over three rings.
    2. D_j is the mean square of the change of the second fundamental form from the scale r_j to
       r_{j+1}, over ln(r_{j+1} / r_j)^2: of polynomials of degrees 6 and 4 and, where noise rules,
       of `ball_regression` within 1.5 to 16 mean edges. Bias grows with a power p of r, which is 6,
       4 and 2, and noise falls, so that D has a minimum; the family with the least D / p^2 is taken
       there. Where noise does not rule, degree 6 is `jet` over three rings.

    Measured on 21 cases, noise of 0 to 0.2 mean edges along the normal on a torus, an ellipsoid and
    a wave of other seeds and sizes than those that NOISE was set on: errors are 1.06 (K) and 1.09
    (H) times the least of 26 fixed fits in the geometric mean, 1.6 and 2.1 times at worst. One
    choice is made for the whole mesh: where noise differs between its parts or a few vertices are
    far off, it is not the best everywhere.

    Order: that of what is taken; O(h^5) for degree 6.

    Source: degree 6 and 4, Cazals, Pouget (2005), Estimating differential quantities using
    polynomial fitting of osculating jets; least change between scales, after Lepski (1991).
    """
    passes = _mended(passes)
    sample = passes.centres
    if len(sample) > SAMPLE:
        sample = np.sort(np.random.default_rng(0).choice(sample, SAMPLE, replace=False))
    function, options, call = _chosen(passes, sample)
    found = passes.estimates(function, **options)
    index = np.zeros(len(passes.vertices), np.uint8)
    curvatures = Curvatures(*(found.get(name) for name in Curvatures._fields))
    return Assessed(*curvatures, None, None, Choice((call,), index))


def _mended(passes):
    """Passes over the mesh whose displaced vertices are brought back. Where several are near each
    other, a round finds the others once the first are back."""
    for _ in range(ROUNDS):
        far = np.flatnonzero((passes.field(suspects)[3:] == 1).any(0))
        far = far[(passes.field(displaced, far)[3:] == 1).any(0)]
        moves = passes.field(placed, far).T
        known = np.isfinite(moves).all(1)
        if not known.any():
            break
        vertices = passes.vertices.copy()
        vertices[far[known]] += moves[known]
        passes = passes.moved(vertices)
    return passes


def _chosen(passes, sample):
    """Function, options and name of the fit that changes least on a sample."""
    degree_6 = jet.estimate, {"degree": 6, "rings": 3}, "jet(degree=6, rings=3)"
    if not len(sample):
        return degree_6
    through, six, four = passes.field(clean, sample)
    exact = not _median(through - six) > NOISE * _median(six - four)
    best = None
    for degree, function in ((6, sextic), (4, quartic)):
        scales = RINGS[degree]
        forms = passes.field(function, sample).reshape(-1, 3, len(sample))
        changes = [
            _change(forms[j], forms[j + 1], scales[j + 1] / scales[j], (1, 2, 1))
            for j in range(len(forms) - 1)
        ]
        j = int(np.argmin(changes))
        risk = changes[j] * RISK[degree]
        if best is None or risk < best[0]:
            best = risk, degree, scales[j]
    risk, degree, rings = best
    if exact and degree == 6:
        return degree_6
    if not exact:
        radius, change = _ball(passes, sample)
        if change * RISK_BALL < risk:
            text = f"{radius} edges"
            return ball_regression.estimate, {"radius": text}, f'ball_regression(radius="{text}")'
    call = f"polynomial(degree={degree}, rings={rings})"
    return polynomial, {"degree": degree, "rings": rings}, call


def _ball(passes, sample):
    """The radius at which ball_regression changes least on a sample, and the change; larger ones
    are tried until it rises. It falls again where the ball is the whole mesh."""
    best, before = (RADII[0], np.inf), None
    for j, radius in enumerate(RADII):
        found = passes.estimates(ball_regression.estimate, sample, radius=f"{radius} edges")
        form = _tensor(found)
        if before is not None:
            change = _change(before, form, radius / RADII[j - 1], np.ones(9))
            if not change < best[1]:
                break
            best = RADII[j - 1], change
        before = form
    return best


def _tensor(found):
    """k1 d1 d1^T + k2 d2 d2^T, (9, m)."""
    return sum(
        (found[k] * found[d][:, None] * found[d][None]).reshape(9, -1)
        for k, d in (("k1", "d1"), ("k2", "d2"))
    )


def _change(a, b, ratio, weights):
    """The trimmed mean of squared differences of two forms over the square of ln(ratio)."""
    squares = np.sort(np.asarray(weights) @ (b - a) ** 2)
    squares = squares[np.isfinite(squares)]
    kept = len(squares) - int(OUTLIERS * len(squares))
    return squares[:kept].mean() / np.log(ratio) ** 2 if kept else np.inf


def _median(x):
    x = np.abs(x[np.isfinite(x)])
    return np.median(x) if len(x) else 0.0
