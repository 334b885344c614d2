"""Circular fitting, section 3.2: circles through a vertex and two of its neighbours."""

from typing import Literal

import numpy as np

from curvlib.fit import least_squares
from curvlib.ring import Normal
from curvlib.vectors import cross, dot, norm

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
    x, y, z = ring.canonical(normal)
    a, b = ring.e[:, i], ring.e[:, j]
    ab, aa, bb = dot(a, b), ring.lengths[i] ** 2, ring.lengths[j] ** 2
    # Inverted at v, the circle is the line through a / |a|^2 and b / |b|^2: its tangent at v.
    tx, ty = x[i] / aa - x[j] / bb, y[i] / aa - y[j] / bb
    tt = tx * tx + ty * ty
    # kappa (n . N), Meusnier (2.1), where kappa n is the circle's curvature vector at v.
    kn = 2 * (z[i] * (1 - ab / aa) + z[j] * (1 - ab / bb)) / (aa + bb - 2 * ab)
    use = _chosen(i, j, np.arctan2(norm(cross(a, b)), ab), n, pairs)
    columns = (use, use * (tx * tx - ty * ty) / tt, use * 2 * tx * ty / tt)
    A, B, C = least_squares(columns, use * kn)
    return A * A - B * B - C * C, A


def _chosen(i, j, angle, n, pairs):
    """1.0 for each pair (i, j) that is used, else 0.0, (pairs, m)."""
    if pairs == "all":
        use = np.ones_like(angle, dtype=bool)
    elif pairs == "opposite":
        best = np.zeros((n, angle.shape[1]))
        for k in range(n):
            best[k] = angle[(i == k) | (j == k)].max(0)
        use = angle >= np.minimum(best[i], best[j]) - TIE
    elif pairs == "ring-opposite":
        gap = np.minimum(j - i, n - (j - i))
        use = np.broadcast_to((gap == n // 2)[:, None], angle.shape)
    else:
        use = angle > np.deg2rad(int(pairs.removeprefix("above-"))) + TIE
    for _ in range(CIRCLES):
        few = use.sum(0) < CIRCLES
        if not few.any():
            break
        rest = np.where(use, -np.inf, angle)
        use = use | (few & (rest >= rest.max(0) - TIE))
    return use.astype(float)
