"""Circular fitting, section 3.2: circles through a vertex and two of its neighbours."""

import math
from typing import Literal

import numpy as np

from curvlib.fit import least_squares
from curvlib.ring import Normal
from curvlib.vectors import dot

LABEL = "Circular fitting"
STYLE = {"color": "#E69F00", "marker": "v", "linestyle": "-"}

TIE = 1e-9  # radians
CIRCLES = 3  # the least number that determines A, B and C

Pairs = Literal["opposite", "ring-opposite", "above-120", "above-90", "all"]


def estimate(ring, normal: Normal = "uniform", pairs: Pairs = "opposite"):
    """K = A^2 - B^2 - C^2 and H = A of kn = A + B cos 2 alpha + C sin 2 alpha (3.7), fitted by
    least squares to circles through v and the chosen pairs of neighbours."""
    unit = ring.e / ring.lengths
    n, m = ring.lengths.shape
    cosine = np.empty((n * (n - 1) // 2, m))
    for rows, gap in _blocks(n):
        cosine[rows] = dot(unit[:, :-gap], unit[:, gap:])
    use = _chosen(cosine, n, pairs)
    use &= (ring.squares > 0).all(0)
    place, i, j = _used(use, n)

    # Inverted at v, the circle is the line through p_i = e_i / |e_i|^2 and p_j. Its point next
    # to v is half the curvature vector of the circle, of which kn is the part along N_v (2.1).
    p = [c / ring.squares for c in ring.canonical(normal)]
    p, q = [c.take(i) for c in p], [c.take(j) for c in p]
    for k in range(3):
        q[k] -= p[k]
    xx, yy = q[0] * q[0], q[1] * q[1]
    scale = 1 / (xx + yy)
    columns = (
        1,
        (xx - yy) * scale,
        2 * q[0] * q[1] * scale,
        2 * (p[2] - dot(p, q) / (xx + yy + q[2] * q[2]) * q[2]),
    )
    # In as many rows as the ring with most of them has, the others filled up with zeros.
    rows = np.zeros((4, place.max(initial=0) // m + 1, m))
    for row, values in zip(rows, columns):
        row.ravel()[place] = values
    rows[3, 0, ~use.any(0)] = np.nan
    A, B, C = least_squares(rows[:3], rows[3])
    return A * A - B * B - C * C, A


def _blocks(n):
    """Yield (rows, gap): where among all pairs i < j of n neighbours those with j - i = gap are."""
    start = 0
    for gap in range(1, n):
        yield slice(start, start + n - gap), gap
        start += n - gap


def _chosen(cosine, n, pairs):
    """Whether each pair (i, j) is used, (pairs, m) bool.

    By the cosine of the angle between them, which spares an arctangent for each pair.
    """
    use = np.empty(cosine.shape, dtype=bool)
    if pairs == "all":
        use[:] = True
    elif pairs == "opposite":
        best = np.full((n, cosine.shape[1]), np.inf)
        for rows, gap in _blocks(n):
            for ends in (best[:-gap], best[gap:]):
                np.minimum(ends, cosine[rows], out=ends)
        best = _ties(best)
        for rows, gap in _blocks(n):
            np.less_equal(cosine[rows], np.maximum(best[:-gap], best[gap:]), out=use[rows])
    elif pairs == "ring-opposite":
        for rows, gap in _blocks(n):
            use[rows] = min(gap, n - gap) == n // 2
    else:
        limit = math.radians(int(pairs.removeprefix("above-"))) + TIE
        np.less(cosine, math.cos(limit), out=use)
    for _ in range(CIRCLES):
        few = use.sum(0, dtype=np.min_scalar_type(len(use))) < CIRCLES
        if not few.any():
            break
        rest = np.where(use, np.inf, cosine)
        use |= few & (rest <= _ties(rest.min(0)))
    return use


def _used(use, n):
    """The used pairs one after another, (used,) each: a place in a flat (rows, m) in the column
    of its ring, and where its v_i and v_j are in the flat (n, m)."""
    m = use.shape[1]
    before = np.zeros(use.shape, dtype=np.min_scalar_type(len(use)))
    # One by one, since np.cumsum walks down each column.
    for k in range(1, len(use)):
        np.add(before[k - 1], use[k - 1], out=before[k])
    i = np.concatenate([np.arange(n - gap) for gap in range(1, n)])
    j = i + np.repeat(np.arange(1, n), np.arange(n - 1, 0, -1))
    place, count = np.flatnonzero(use), np.count_nonzero(use, axis=1)
    rings = place - np.repeat(np.arange(len(use)) * m, count)
    rows = before.take(place) * np.intp(m)
    return rings + rows, *(rings + np.repeat(k * m, count) for k in (i, j))


def _ties(cosine):
    """The cosine of an angle less by TIE."""
    square = cosine * cosine
    sine = np.sqrt(np.maximum(np.subtract(1, square, out=square), 0, out=square), out=square)
    return np.add(cosine, np.multiply(sine, TIE, out=sine), out=sine)
