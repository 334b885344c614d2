"""Circular fitting, section 3.2: circles through a vertex and two of its neighbours."""

import math
from typing import Literal

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.fit import CUTOFF, fold, least_squares
from curvlib.kit.frame import Normal, canonical, unit_normal
from curvlib.kit.ring import zeros
from curvlib.kit.vectors import at, dot

LABEL = "Circular fitting"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#E69F00", "marker": "v", "linestyle": "-"}

# Angles closer than this, in radians, are equal. Rounding to float32 breaks ties among the right
# angles of voxels and mechanical parts, with 1e-9 at four times as many vertices of real meshes.
# Compared with 1e-9, errors of the study change by 1e-5 at most (relative); with 3e-6 one by a
# quarter.
TIE = 2e-6
CIRCLES = 3  # the least number that determines A, B and C
# K and H are NaN beyond this valence: the number of pairs is quadratic in it.
MOST = 1024
MOST_ROWS = 64  # circles held at a time; more are folded into three rows

# The choice of pairs by their angle: the cosine up to which a pair is used.
COSINES = {
    "all": np.inf,
    "above-90": math.cos(math.radians(90) + TIE),
    "above-120": math.cos(math.radians(120) + TIE),
    "ring-opposite": -np.inf,
}

Pairs = Literal["opposite", "ring-opposite", "above-120", "above-90", "all"]


def estimate(ring, normal: Normal = "uniform", pairs: Pairs = "opposite"):
    """K = A^2 - B^2 - C^2 and H = A of kn = A + B cos 2 alpha + C sin 2 alpha (3.7), fitted by
    least squares to the circles through v and two of its neighbours.

    Parameters
    ----------
    ring : Ring
        Batch of m closed one-rings of one valence n.
    normal : {"uniform", "area", "exact"}
        N_v: the mean of the facet normals (3.3), plain or weighted by area, or the mesh's own.
    pairs : {"opposite", "ring-opposite", "above-120", "above-90", "all"}
        The neighbours that share a circle: each with the one at the largest angle at v, or with
        the one half way round the ring; all at an angle above 120 or 90 degrees; or all. Fewer
        than three are topped up by the largest angles left. Angles that differ by less than TIE
        are equal.

    Returns
    -------
    K, H : ndarray, (m,)
        Pointwise, in 1/length^2 and 1/length, H > 0 where the surface bends away from its normal.
        NaN: needs a closed one-ring; a valence of at most MOST.

    Raises
    ------
    InputError
        normal="exact" and the mesh has no normals.

    Notes
    -----
    Singular values below CUTOFF times the largest are cut off: circles that nearly coincide
    determine A alone.

    Order: none proven. Measured on shrinking regular rings of even valence, from 6 on: O(h^2); on
    irregular rings the error does not vanish, even with exact normals.

    Source: Surazhsky et al. (2003), section 3.2.
    """
    _, n, m = ring.e.shape
    if n > MOST:
        undefined = np.full(m, np.nan)
        return undefined, undefined
    unit, inverted = ring.e / ring.lengths, canonical(ring, unit_normal(ring, normal))
    inverted /= ring.squares
    steps = n // 2 if pairs == "ring-opposite" else n
    limits = _largest(unit) if pairs == "opposite" else np.full((n, m), COSINES[pairs])
    more, circles = _at_least_three(unit, steps, limits)
    # Rings with fewer circles than the largest of the batch are padded with rows of zeros.
    rows = min(max(1, int(circles.max())), MOST_ROWS)
    columns, row = np.zeros((4, rows, m)), np.zeros(m, np.intp)
    place = _fill(columns, row, 0, unit, inverted, steps, limits, more)
    while place < n * n * m:
        fold(columns)
        np.minimum(row, 3, out=row)
        place = _fill(columns, row, place, unit, inverted, steps, limits, more)
    columns[3, 0, row == 0] = np.nan
    A, B, C = least_squares(columns, CUTOFF)
    return A * A - B * B - C * C, A


@compiled
def _fill(columns, row, place, unit, inverted, steps, limits, more):
    """Write a row of columns (4, rows, m) for each circle, from `place` on in the order of i, j, k,
    and count those of each ring in row (m,). Returns the place of the first that finds no room."""
    _, n, m = unit.shape
    first = place % m
    for pair in range(place // m, n * n):
        i, j = pair // n, pair % n
        for k in range(first, m if i < j else 0):
            if _chosen(unit, i, j, k, steps, limits, more[k]):
                if row[k] == columns.shape[1]:
                    return pair * m + k
                (x, y, z), (dx, dy, dz) = at(inverted, i, k), at(inverted, j, k)
                dx, dy, dz = dx - x, dy - y, dz - z
                xx, yy = dx * dx, dy * dy
                # Inversion at v maps the circle to the line through the two images. Its point
                # nearest to v is half the curvature vector; kn is twice its z (2.1).
                nearest = (x * dx + y * dy + z * dz) / (xx + yy + dz * dz)
                r, row[k] = row[k], row[k] + 1
                columns[0, r, k] = 1
                columns[1, r, k] = (xx - yy) / (xx + yy)
                columns[2, r, k] = 2 * dx * dy / (xx + yy)
                columns[3, r, k] = 2 * (z - nearest * dz)
        first = 0
    return n * n * m


@compiled
def _largest(unit):
    """The cosine of the largest angle at each e_i, with its ties, (n, m)."""
    _, n, m = unit.shape
    out = np.empty((n, m))
    for i in range(n):
        for k in range(m):
            out[i, k] = np.inf
    for i in range(n):
        for j in range(i + 1, n):
            for k in range(m):
                cosine = dot(at(unit, i, k), at(unit, j, k))
                out[i, k] = cosine if cosine < out[i, k] else out[i, k]
                out[j, k] = cosine if cosine < out[j, k] else out[j, k]
    for i in range(n):
        for k in range(m):
            out[i, k] = _tied(out[i, k])
    return out


@compiled
def _at_least_three(unit, steps, limits):
    """The cosine (m,) up to which further pairs are used, so that each ring has CIRCLES of them:
    the largest angle left with its ties, one after another. And the number of circles, (m,)."""
    _, n, m = unit.shape
    more, circles = np.empty(m), zeros(m)
    for k in range(m):
        more[k] = -np.inf
    for i in range(n):
        for j in range(i + 1, n):
            for k in range(m):
                circles[k] += _chosen(unit, i, j, k, steps, limits, -np.inf)
    for k in range(m):
        for _ in range(CIRCLES):
            if circles[k] >= CIRCLES:
                break
            best = np.inf
            for i in range(n):
                for j in range(i + 1, n):
                    if not _chosen(unit, i, j, k, steps, limits, more[k]):
                        cosine = dot(at(unit, i, k), at(unit, j, k))
                        best = cosine if cosine < best else best
            more[k], circles[k] = _tied(best), 0.0
            for i in range(n):
                for j in range(i + 1, n):
                    circles[k] += _chosen(unit, i, j, k, steps, limits, more[k])
    return more, circles


@compiled
def _chosen(unit, i, j, k, steps, limits, more):
    """Whether the pair i < j of ring k is used: if it is `steps` or more apart on the ring, or if
    the cosine of its angle is at most limits[i] or limits[j], (n, m), or `more`.

    Comparing cosines saves an arctangent a pair.
    """
    limit = limits[i, k] if limits[i, k] > limits[j, k] else limits[j, k]
    limit = more if more > limit else limit
    # No branches: the loops over k are vectorised.
    far = (j - i >= steps) & (unit.shape[1] - j + i >= steps)
    return far | (dot(at(unit, i, k), at(unit, j, k)) <= limit)


@compiled
def _tied(cosine):
    """The cosine of an angle that is smaller by TIE, at all angles to a hundredth of TIE: next to
    pi, TIE moves the cosine by 2e-12, and rounding moves it by 1e-16."""
    sine = math.sqrt(1 - cosine * cosine) if abs(cosine) < 1 else 0.0
    return cosine * math.cos(TIE) + sine * math.sin(TIE)
