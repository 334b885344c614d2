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
    n = ring.e.shape[1]
    i, j = np.triu_indices(n, 1)
    unit = ring.e / ring.lengths
    cosine = dot(unit[:, i], unit[:, j])
    use = _chosen(i, j, cosine, n, pairs)
    some = use.any(1)
    i, j, cosine, use = i[some], j[some], cosine[some], use[some].astype(float)

    # Inverted at v, the circle is the line through e_i / |e_i|^2 and e_j / |e_j|^2: its tangent.
    square = ring.lengths * ring.lengths
    x, y, z = ring.canonical(normal)
    x, y, w = x / square, y / square, z / square
    tx, ty = x[i] - x[j], y[i] - y[j]
    txx, tyy = tx * tx, ty * ty
    # kappa (n . N), Meusnier (2.1), where kappa n is the circle's curvature vector at v.
    scalar = cosine * ring.lengths[i] * ring.lengths[j]
    kn = z[i] + z[j] - scalar * (w[i] + w[j])
    kn *= 2 / (square[i] + square[j] - 2 * scalar)
    scale = use / (txx + tyy)
    columns = (use, scale * (txx - tyy), scale * (2 * tx * ty))
    A, B, C = least_squares(columns, use * kn)
    return A * A - B * B - C * C, A


def _chosen(i, j, cosine, n, pairs):
    """Whether each pair (i, j) is used, (pairs, m) bool.

    By the cosine of the angle between them, which spares an arctangent for each pair.
    """
    if pairs == "all":
        use = np.ones_like(cosine, dtype=bool)
    elif pairs == "opposite":
        best = np.array([cosine[(i == k) | (j == k)].min(0) for k in range(n)])
        best = _ties(best)
        use = cosine <= np.maximum(best[i], best[j])
    elif pairs == "ring-opposite":
        gap = np.minimum(j - i, n - (j - i))
        use = np.broadcast_to((gap == n // 2)[:, None], cosine.shape)
    else:
        limit = math.radians(int(pairs.removeprefix("above-"))) + TIE
        use = cosine < math.cos(limit)
    for _ in range(CIRCLES):
        few = use.sum(0) < CIRCLES
        if not few.any():
            break
        rest = np.where(use, np.inf, cosine)
        use = use | (few & (rest <= _ties(rest.min(0))))
    return use


def _ties(cosine):
    """The cosine of an angle less by TIE."""
    return cosine + TIE * np.sqrt(np.maximum(1 - cosine * cosine, 0))
