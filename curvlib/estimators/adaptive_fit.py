"""The fit and its scale that change least, region by region: chosen from the mesh itself."""

from collections import namedtuple

import numpy as np

from curvlib.kit.compiled import kernel
from curvlib.kit.displaced import displaced, placed, suspects
from curvlib.kit.options import Length
from curvlib.kit.scales import RINGS, forms, means, nearest, ratios
from curvlib.kit.tensor import Assessed, Choice, Curvatures

from . import ball_regression, compact_hermite, jet
from ._errors import Errors

LABEL = "Adaptive fit"
SOURCE = "https://doi.org/10.1016/j.cagd.2004.09.004"
STYLE = {"color": "#000000", "marker": "P", "linestyle": "-"}
GLOBAL = "the choice is made from vertices all over the mesh"
# What it does at creases of a mesh.
CREASES = "one-sided"
PRECISION = compact_hermite.PRECISION

# Of searches for displaced vertices.
ROUNDS = 3
# Vertices on which the choice is made, and how many of them, those nearby, decide it for each; the
# largest part of these, by change, that is left out of their mean.
SAMPLE, NEAR, OUTLIERS = 800, 64, 0.05
# Balls are compared on one of so many.
FEWER = 4
RADII = 1.5, 2, 2.8, 4, 5.6, 8, 11, 16  # in mean edges
# The change of H from three rings to four, in the median and over H, up to which a mesh is fine.
SETTLED = 0.1
# Vertices in a ball: that of 16 edges has 930 of a mesh whose edges are equal.
CROWDED = 2048
# The square of the error over the change where that is least; for polynomials times the rings.
RISK, RISK_BALL = {6: 0.06, 4: 0.085}, 0.042
# The ratio of the difference of two fits of degree 6 over three rings to that of three and four
# rings: below the one truncation rules, above the other noise.
CLEAN, NOISY = 0.28, 0.6
# What holds of a place has to hold of more than this part of the nearest BESIDE of the sample.
BESIDE, MOST = 16, 0.9
# On a smaller part of a mesh compact_hermite, which is solved on all of it, is not taken.
FEW = 0.1
# A region has a choice of its own where its errors or its noise differ by this factor.
APART = 1.7

Fit = namedtuple("Fit", "function options")
COMPACT = Fit(compact_hermite.estimate, {"degree": 6})
THROUGH = Fit(jet.estimate, {"degree": 6, "rings": 3})


def estimate(passes):
    """All of K, H, k1, k2, d1 and d2 of one of four fits, at one of several scales: in each region
    of that which changes least from scale to scale.

    Parameters
    ----------
    passes : Passes
        Over the mesh.

    Returns
    -------
    Assessed
        Pointwise, in 1/length^2 and 1/length, positive where the surface bends away from its
        normal; d1 and d2 are NaN at an umbilic. NaN: needs a disk or half-disk of triangles.
        Vertices on a boundary have values. `K_error`, `H_error`, `k1_error` and `k2_error` are
        standard errors, in the units of these, NaN where these are. `choice` has the calls that
        were taken.

    Notes
    -----
    Vertices far off the surface of their neighbours (`curvlib.kit.displaced`) are first brought
    back to it, and have its curvature. The choice is made on 800 vertices, for each from the 64
    nearest of them; the others have that of the nearest of the 800.

    1. Two jets of degree 6 over three rings, one through the vertex and weighted, differ by 0.15 to
       0.25 of the difference between three and four rings where truncation rules, by 1 to 1.4 of it
       where noise does, at any resolution. Below 0.28 `compact_hermite` has the smaller errors:
       vertices are exact, to 1e-6 of an edge or so on 2,500 of them.
    2. Elsewhere D_j is the mean square of the change of the second fundamental form from the scale
       r_j to r_{j+1}, over ln(r_{j+1} / r_j)^2, without the largest twentieth: of jets of degrees 6
       and 4 by approximation over 3 to 10 rings, and of `ball_regression` within 1.5 to 11 mean
       edges. Bias grows with the scale and noise falls. Where D_j / r_j, for balls D_j, is least,
       the square of the error was 0.012 D at degree 6, 0.017 D at 4, 0.042 D for balls, in the
       median of 90 cases; by this the family is chosen. Below a ratio of 0.6 the jet of degree 6
       over three rings is that through the vertex.
    3. A place has another fit than the mesh's best where that has less than 1 / 1.7^2 of its risk.
       On white noise over all of the mesh errors are those of one choice, to 1.05 times.

    `snakemake adaptive` compares it with 26 fixed fits, on a torus, a closed and an open surface of
    2,500 vertices; constants were set on others. Ratios of its errors of K and H to those of the
    best of them, the geometric mean and the worst:

    ==================================== ========== ==========
    noise                                mean       worst
    ==================================== ========== ==========
    white, 0 to 0.2 mean edges           1.03, 1.06 1.36, 1.83
    in all directions, 0.01, 0.05        1.08, 1.17 1.42, 1.94
    correlated over some edges           1.07, 1.29 1.40, 2.45
    coordinates rounded to 0.01, 0.1     1.00, 1.00 1.00, 1.01
    float32                              1.01, 1.01 1.02, 1.03
    white on one half                    0.85, 0.89 1.01, 1.16
    0.5 % displaced by 5 edges           0.01, 0.02 0.28, 0.66
    ==================================== ========== ==========

    Where K and H want different fits, as on a torus in noise of 0.01 edges, it is near the best for
    one of them. Balls of more than 11 edges, which a million vertices in much noise want, are not
    tried.

    Standard errors are made of the variance of residuals and of the change to the next scale
    (`_errors.py`). `snakemake coverage` counts, on five surfaces on which no constants were set,
    how many vertices inside have an error of K and H within one and two of them, in the mean, and
    the least part within two:

    ==================================== ============== ============== ==========
    noise                                within 1       within 2       least
    ==================================== ============== ============== ==========
    none                                 0.93, 0.95     0.98, 0.99     0.94, 0.97
    white, 1e-5 to 0.2 mean edges        0.71, 0.70     0.95, 0.95     0.88, 0.87
    in all directions, 0.01, 0.05        0.69, 0.70     0.95, 0.95     0.89, 0.89
    white on one half                    0.75, 0.76     0.94, 0.94     0.92, 0.92
    correlated over some edges           0.47, 0.46     0.76, 0.75     0.45, 0.44
    coordinates rounded to 0.01, 0.1     0.71, 0.68     0.96, 0.95     0.92, 0.91
    spheres of voxels                    0.67, 0.67     0.94, 0.94     0.88, 0.89
    ==================================== ============== ============== ==========

    For exact vertices, whose errors are of truncation, they are 4 to 6 times these in the median.
    Noise that is correlated over some edges looks like shape: there they are half as large as they
    should be. For staircases exact is the sphere of the vertices' mean distance: that all of them
    lie off the surface is not known from the mesh. Near creases they mean nothing.

    Cost: on a million exact vertices 22 to 28 times libigl's `gaussian_curvature`, and on 200,000 4
    to 5 times for standard errors; in noise, with balls of 11 edges, 110 times, and half as much
    again for these.

    Order: that of what is taken; O(h^5) for degree 6.

    Source: degree 6 and 4, Cazals, Pouget (2005), Estimating differential quantities using
    polynomial fitting of osculating jets; least change between scales, after Lepski (1991).
    """
    passes = _mended(passes)
    sample = passes.centres
    if len(sample) > SAMPLE:
        sample = np.sort(np.random.default_rng(0).choice(sample, SAMPLE, replace=False))
    fits, chosen = _chosen(passes, sample)
    index = np.zeros(len(passes.vertices), np.uint8)
    if len(fits) > 1:
        from scipy.spatial import cKDTree

        index[:] = chosen[cKDTree(passes.vertices[sample]).query(passes.vertices)[1]]
    every = [np.flatnonzero(index == k) for k in range(len(fits))] if len(fits) > 1 else [None]
    found, errors = {}, Errors(passes)
    for fit, vertices in zip(fits, every):
        for name, x in errors.values(fit, vertices).items():
            if vertices is None:
                found[name] = x
            else:
                whole = found.setdefault(name, np.full((*x.shape[:-1], len(index)), np.nan))
                whole[..., vertices] = x
    curvatures = Curvatures(*(found.get(name) for name in Curvatures._fields))
    sure = errors.standard(found) if found else (None,) * 4
    return Assessed(*curvatures, *sure, Choice(tuple(map(_call, fits)), index))


def _call(fit):
    options = ", ".join(f"{name}={value!r}" for name, value in fit.options.items())
    return f"{fit.function.__module__.split('.')[-1]}({options})"


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
    """The fits that are taken, and which of them at each vertex of the sample."""
    if not len(sample):
        return [THROUGH], None
    points, (through, of_six) = passes.vertices[sample], _forms(passes, sample, 6)
    three, four = (of_six[:2, 0] + of_six[:2, 2]) / 2
    noise = ratios(through - three, four - three, nearest(points, points, NEAR))
    beside = nearest(points, points, BESIDE)
    exact, quiet = (
        # Those beside it, too: one of them may be where noise begins.
        (noise[:-1] < limit * (APART if noise[-1] < limit else 1))[beside].mean(1) > MOST
        for limit in (CLEAN, NOISY)
    )
    if exact.all():
        return [COMPACT], None
    rest = np.flatnonzero(~exact | (exact.mean() < FEW))
    fits, index = _least(passes, sample[rest], of_six[..., rest], quiet[rest])
    taken, chosen = np.unique(index, return_inverse=True)
    if len(rest) == len(sample):
        return [fits[k] for k in taken], chosen
    every = np.full(len(sample), len(taken))
    every[rest] = chosen
    return [*(fits[k] for k in taken), COMPACT], every


def _forms(passes, sample, degree):
    """What `forms` returns at a sample: (m,) and, for each scale of a degree, (3, m)."""
    scales = RINGS[degree]
    through, *found = passes.field(forms, sample, degree=degree, rings=scales[-1])
    return through, np.reshape(found[: 3 * len(scales)], (-1, 3, len(sample)))


def _least(passes, sample, of_six, quiet):
    """Fits, and which of them has the least risk at each vertex of a sample; `of_six` are forms of
    degree 6 there, `quiet` where noise does not rule."""
    points, fits, risks = passes.vertices[sample], [], []
    near = nearest(points, points, NEAR)
    _, of_four = _forms(passes, sample, 4)
    for degree, each in ((6, of_six), (4, of_four)):
        scales = RINGS[degree]
        for j in range(len(scales) - 1):
            options = {"degree": degree, "rings": scales[j], "fit": "approximation"}
            fits.append(Fit(jet.estimate, options))
            change = np.array((1, 2, 1)) @ (each[j + 1] - each[j]) ** 2
            over = scales[j] * np.log(scales[j + 1] / scales[j]) ** 2
            risks.append(RISK[degree] / over * means(change, near, OUTLIERS))
    few, (three, four) = sample[::FEWER], of_six[:2, 0] + of_six[:2, 2]
    alike = ratios(four - three, three, np.arange(len(sample))[None])[-1] < SETTLED
    # Balls have the least errors in noise, and on meshes that are coarse for their surface.
    balls = not (quiet.all() and alike)
    near = nearest(points, points[::FEWER], NEAR)
    for radius, change in _balls(passes, few, near) if balls else ():
        fits.append(Fit(ball_regression.estimate, {"radius": f"{radius} edges"}))
        risks.append(RISK_BALL * change)
    risks = np.array(risks)
    own, shared = risks[:, :-1].argmin(0), risks[:, -1].argmin()
    apart = APART**2 * risks[own, np.arange(len(sample))] < risks[shared, :-1]
    index = np.where(apart, own, shared)
    return [*fits, THROUGH], np.where((index == 0) & quiet, len(fits), index)


def _balls(passes, sample, near):
    """Yield radii of ball_regression and the means of changes to the next over the square of the
    logarithm of their ratio, until these rise everywhere. They fall again where the ball is the
    whole mesh."""
    least, before, last = np.full(len(near) + 1, np.inf), None, None
    for radius in RADII:
        some = sample[:: 1 + len(sample) // 8]
        if passes.field(_count, some, radius=f"{radius} edges").mean() > CROWDED:
            break
        found = passes.estimates(ball_regression.estimate, sample, radius=f"{radius} edges")
        form = _tensor(found)
        if before is not None:
            squares = ((form - before) ** 2).sum(0) / np.log(radius / last) ** 2
            change = means(squares, near, OUTLIERS)
            falling = change < least
            if falling.mean() < OUTLIERS:
                break
            least = np.where(falling, change, -np.inf)
            yield last, np.where(falling, change, np.inf)
        before, last = form, radius


def _tensor(found):
    """k1 d1 d1^T + k2 d2 d2^T, (9, m)."""
    return sum(
        (found[k] * found[d][:, None] * found[d][None]).reshape(9, -1)
        for k, d in (("k1", "d1"), ("k2", "d2"))
    )


@kernel
def _count(disk, radius: Length = None):
    """How many vertices lie within `radius` of that of a `disk`."""
    return (disk.count + 0.0,)
