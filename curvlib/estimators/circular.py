"""Circular fitting, section 3.2: circles through a vertex and two of its neighbours."""

import math
from typing import Literal

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.fit import least_squares
from curvlib.kit.ring import Normal, canonical, unit_normal
from curvlib.kit.vectors import at, dot

LABEL = "Circular fitting"
STYLE = {"color": "#E69F00", "marker": "v", "linestyle": "-"}

TIE = 1e-9  # radians
CIRCLES = 3  # the least number that determines A, B and C

Pairs = Literal["opposite", "ring-opposite", "above-120", "above-90", "all"]


@compiled
def estimate(ring, normal: Normal = "uniform", pairs: Pairs = "opposite"):
    """K = A^2 - B^2 - C^2 and H = A of kn = A + B cos 2 alpha + C sin 2 alpha (3.7), fitted by
    least squares to circles through v and the chosen pairs of neighbours."""
    unit, inverted = _unit(ring), _inverted(ring, unit_normal(ring, normal))
    steps, limits = _limits(unit, pairs)
    more, circles = _at_least_three(unit, steps, limits)
    _, n, m = inverted.shape
    # As many rows as the ring with most circles has, in others filled up with zeros.
    columns, row = np.zeros((4, max(1, circles.max()), m)), np.zeros(m, np.intp)
    for i in range(n):
        for j in range(i + 1, n):
            for k in range(m):
                if _chosen(unit, i, j, k, steps, limits, more[k]):
                    (x, y, z), (dx, dy, dz) = at(inverted, i, k), at(inverted, j, k)
                    dx, dy, dz = dx - x, dy - y, dz - z
                    xx, yy = dx * dx, dy * dy
                    # The circle, inverted at v, is this line. Its point next to v is half the
                    # circle's curvature vector, of which kn is the part along N_v (2.1).
                    nearest = (x * dx + y * dy + z * dz) / (xx + yy + dz * dz)
                    r, row[k] = row[k], row[k] + 1
                    columns[0, r, k] = 1
                    columns[1, r, k] = (xx - yy) / (xx + yy)
                    columns[2, r, k] = 2 * dx * dy / (xx + yy)
                    columns[3, r, k] = 2 * (z - nearest * dz)
    for i in range(n):
        for k in range(m):
            if row[k] == 0 or ring.squares[i, k] == 0:
                columns[3, 0, k] = np.nan
    A, B, C = least_squares(columns)
    return A * A - B * B - C * C, A


@compiled
def _unit(ring):
    """e_i / |e_i|, (3, n, m)."""
    out = np.empty_like(ring.e)
    for c in range(3):
        for i in range(out.shape[1]):
            for k in range(out.shape[2]):
                out[c, i, k] = ring.e[c, i, k] / ring.lengths[i, k]
    return out


@compiled
def _inverted(ring, N):
    """e_i / |e_i|^2 in the canonical form, (3, n, m)."""
    out = canonical(ring, N)
    for c in range(3):
        for i in range(out.shape[1]):
            for k in range(out.shape[2]):
                out[c, i, k] /= ring.squares[i, k]
    return out


@compiled
def _limits(unit, pairs):
    """How pairs are chosen: those `steps` or more apart on the ring, and each (i, j) of which
    the cosine of the angle is at most limits[i] or limits[j], (n, m).

    Cosines spare an arctangent for each pair.
    """
    _, n, m = unit.shape
    limits = np.full((n, m), -np.inf)
    if pairs == "all":
        return 1, limits
    if pairs == "ring-opposite":
        return n // 2, limits
    if pairs == "opposite":
        limits[:] = np.inf
        for i in range(n):
            for j in range(i + 1, n):
                for k in range(m):
                    cosine = dot(at(unit, i, k), at(unit, j, k))
                    limits[i, k] = min(limits[i, k], cosine)
                    limits[j, k] = min(limits[j, k], cosine)
        for i in range(n):
            for k in range(m):
                limits[i, k] = _tied(limits[i, k])
    else:
        limits[:] = math.cos(math.radians(120 if pairs == "above-120" else 90) + TIE)
    return n, limits


@compiled
def _at_least_three(unit, steps, limits):
    """The cosine up to which pairs join that are not chosen yet, (m,), so that there are CIRCLES:
    the next best and its ties, one after another; and how many circles that makes, (m,)."""
    _, n, m = unit.shape
    more, circles = np.full(m, -np.inf), np.zeros(m, np.intp)
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
                        best = min(best, dot(at(unit, i, k), at(unit, j, k)))
            more[k], circles[k] = _tied(best), 0
            for i in range(n):
                for j in range(i + 1, n):
                    circles[k] += _chosen(unit, i, j, k, steps, limits, more[k])
    return more, circles


@compiled
def _chosen(unit, i, j, k, steps, limits, more):
    """Whether the pair i < j of ring k is used."""
    if min(j - i, unit.shape[1] - j + i) >= steps:
        return True
    return dot(at(unit, i, k), at(unit, j, k)) <= max(limits[i, k], limits[j, k], more)


@compiled
def _tied(cosine):
    """The cosine of an angle less by TIE."""
    return cosine + TIE * math.sqrt(max(1 - cosine * cosine, 0.0))
