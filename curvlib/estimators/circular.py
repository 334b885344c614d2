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
    n = unit.shape[1]
    i, j = _pairs(n)
    cosine = np.concatenate([dot(unit[:, :-gap], unit[:, gap:]) for gap in range(1, n)])
    use = _chosen(i, j, cosine, n, pairs) & (ring.lengths > 0).all(0)
    use, pair, i, j = _used(use, i, j)

    # Inverted at v, the circle is the line through e_i / |e_i|^2 and e_j / |e_j|^2: its tangent.
    square = ring.lengths * ring.lengths
    x, y, z = ring.canonical(normal)
    x, y, w = x / square, y / square, z / square
    tx, ty = x.take(i) - x.take(j), y.take(i) - y.take(j)
    txx, tyy = tx * tx, ty * ty
    # kappa (n . N), Meusnier (2.1), where kappa n is the circle's curvature vector at v.
    scalar = cosine.take(pair) * ring.lengths.take(i) * ring.lengths.take(j)
    kn = z.take(i) + z.take(j) - scalar * (w.take(i) + w.take(j))
    kn *= 2 / (square.take(i) + square.take(j) - 2 * scalar)
    scale = np.where(use, 1 / (txx + tyy), 0)
    columns = (use, scale * (txx - tyy), scale * (2 * tx * ty))
    kn = np.where(use, kn, 0)
    kn[:, ~use.any(0)] = np.nan
    A, B, C = least_squares(columns, kn)
    return A * A - B * B - C * C, A


def _pairs(n):
    """All pairs i < j of n neighbours, (pairs,) each, in blocks of equal j - i."""
    i = np.concatenate([np.arange(n - gap) for gap in range(1, n)])
    return i, i + np.repeat(np.arange(1, n), np.arange(n - 1, 0, -1))


def _chosen(i, j, cosine, n, pairs):
    """Whether each pair (i, j) is used, (pairs, m) bool.

    By the cosine of the angle between them, which spares an arctangent for each pair.
    """
    if pairs == "all":
        use = np.ones_like(cosine, dtype=bool)
    elif pairs == "opposite":
        best = np.full((n, cosine.shape[1]), np.inf)
        blocks = np.split(cosine, np.cumsum(np.arange(n - 1, 1, -1)))
        for gap, block in enumerate(blocks, 1):
            for ends in (best[:-gap], best[gap:]):
                np.minimum(ends, block, out=ends)
        best = _ties(best)
        use = np.concatenate(
            [block <= np.maximum(best[:-gap], best[gap:]) for gap, block in enumerate(blocks, 1)]
        )
    elif pairs == "ring-opposite":
        gap = np.minimum(j - i, n - (j - i))
        use = np.broadcast_to((gap == n // 2)[:, None], cosine.shape)
    else:
        limit = math.radians(int(pairs.removeprefix("above-"))) + TIE
        use = cosine < math.cos(limit)
    for _ in range(CIRCLES):
        few = use.sum(0, dtype=np.min_scalar_type(len(use))) < CIRCLES
        if not few.any():
            break
        rest = np.where(use, np.inf, cosine)
        use = use | (few & (rest <= _ties(rest.min(0))))
    return use


def _used(use, i, j):
    """The used pairs alone, in as many rows as the ring with most of them has.

    Returns (rows, m) each: whether a row is used, where its pair is in the flat (pairs, m), and
    where its v_i and v_j are in the flat (n, m).
    """
    m = use.shape[1]
    count = use.cumsum(0, dtype=np.min_scalar_type(len(use)))
    rows = max(1, count[-1].max())
    same = np.flatnonzero(use.any(1))
    if len(same) == rows:  # the same pairs in all rings
        used, pairs = use[same], same[:, None] * m + np.arange(m)
    else:
        places = np.flatnonzero(use)
        pairs = np.full((rows, m), -1)
        pairs.ravel()[(count.take(places) - np.intp(1)) * m + places % m] = places
        used = pairs >= 0
        np.maximum(pairs, np.arange(m), out=pairs)  # unused: a place in its own ring
    pair = pairs // m
    return used, pairs, *(((k - np.arange(len(k))) * m).take(pair) + pairs for k in (i, j))


def _ties(cosine):
    """The cosine of an angle less by TIE."""
    return cosine + TIE * np.sqrt(np.maximum(1 - cosine * cosine, 0))
