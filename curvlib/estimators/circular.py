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
    unit, inverted = _inverted(ring.e, ring.lengths, canonical(ring, unit_normal(ring, normal)))
    steps = n // 2 if pairs == "ring-opposite" else n
    limits = _largest(unit) if pairs == "opposite" else np.full((n, m), COSINES[pairs])
    used, circles = _used(unit, steps, limits)
    # Rings with fewer circles than the largest of the batch are padded with rows of zeros.
    rows = min(max(1, int(circles.max())), MOST_ROWS)
    columns, row = np.zeros((4, rows, m)), np.zeros(m, np.intp)
    place = _fill(columns, row, 0, inverted, used)
    while place < used.size:
        fold(columns)
        np.minimum(row, 3, out=row)
        place = _fill(columns, row, place, inverted, used)
    columns[3, 0, row == 0] = np.nan
    A, B, C = least_squares(columns, CUTOFF)
    return A * A - B * B - C * C, A


@compiled
def _inverted(e, lengths, images):
    """e_i / |e_i|, (3, n, m); and e_i / |e_i|^2 in the canonical form, from e_i in it."""
    unit = np.empty(e.shape)
    for i in range(e.shape[1]):
        for k in range(e.shape[2]):
            inverse = 1 / lengths[i, k]
            for c in range(3):
                unit[c, i, k] = e[c, i, k] * inverse
                images[c, i, k] *= inverse * inverse
    return unit, images


@compiled
def _fill(columns, row, place, inverted, used):
    """Write a row of columns (4, rows, m) for each circle, from `place` in `used` (pairs, m) on,
    and count those of each ring in row (m,). Returns the place of the first that finds no room."""
    _, n, m = inverted.shape
    pair = 0
    for i in range(n):
        for j in range(i + 1, n):
            for k in range(max(place - pair * m, 0), m):
                if used[pair, k]:
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
            pair += 1
    return used.size


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
def _used(unit, steps, limits):
    """Whether each pair i < j is used, (pairs, m), and the number of circles, (m,).

    A pair is used if it is `steps` or more apart on the ring, or if the cosine of its angle, which
    saves an arctangent, is at most limits[i] or limits[j], (n, m). Rings with less than CIRCLES of
    them use the largest angles left with their ties, one after another.
    """
    _, n, m = unit.shape
    used, circles = np.empty((n * (n - 1) // 2, m), np.bool_), zeros(m)
    pair = 0
    for i in range(n):
        for j in range(i + 1, n):
            far = j - i >= steps and n - j + i >= steps
            for k in range(m):
                limit = limits[i, k] if limits[i, k] > limits[j, k] else limits[j, k]
                # No branches: the loop is vectorised.
                chosen = far | (dot(at(unit, i, k), at(unit, j, k)) <= limit)
                used[pair, k] = chosen
                circles[k] += chosen
            pair += 1
    for k in range(m):
        for _ in range(CIRCLES):
            if circles[k] >= CIRCLES:
                break
            _use_largest(unit, k, used, circles)
    return used, circles


@compiled
def _use_largest(unit, k, used, circles):
    """Use the pairs of ring k with the largest angle of those left, and its ties."""
    n, pair, best = unit.shape[1], 0, np.inf
    for i in range(n):
        for j in range(i + 1, n):
            cosine = dot(at(unit, i, k), at(unit, j, k))
            best = cosine if not used[pair, k] and cosine < best else best
            pair += 1
    pair, limit = 0, _tied(best)
    for i in range(n):
        for j in range(i + 1, n):
            if not used[pair, k] and dot(at(unit, i, k), at(unit, j, k)) <= limit:
                used[pair, k] = True
                circles[k] += 1
            pair += 1


@compiled
def _tied(cosine):
    """The cosine of an angle that is smaller by TIE, at all angles to a hundredth of TIE: next to
    pi, TIE moves the cosine by 2e-12, and rounding moves it by 1e-16."""
    sine = math.sqrt(1 - cosine * cosine) if abs(cosine) < 1 else 0.0
    return cosine * math.cos(TIE) + sine * math.sin(TIE)
