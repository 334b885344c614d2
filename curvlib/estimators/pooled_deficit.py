"""Angle deficit and edge angles of the Gauss-Bonnet scheme, summed over rings or a ball."""

import math
from typing import Literal

from curvlib.kit.compiled import compiled, kernel
from curvlib.kit.options import Length
from curvlib.kit.ring import beta, total, total_angle, weighted_total

LABEL = "Pooled deficit"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#0072B2", "marker": "p", "linestyle": "--"}


@compiled
def cells(ring):
    """Of each vertex of the batch `ring` the integrals of K and H over its cell, (3.12) and (3.13),
    and the area of the cell, a third of the ring's, (m,)."""
    deficits, areas = total_angle(ring), total(ring.areas)
    edges = weighted_total(ring.lengths, beta(ring))
    for k in range(len(areas)):
        deficits[k] = 2 * math.pi - deficits[k]
        edges[k] /= 4
        areas[k] /= 3
    return deficits, edges, areas


@kernel
def estimate(disk, cells, rings: Literal[1, 2, 3] = 1, radius: Length = None):
    """K = sum (2 pi - sum alpha_i) / sum (A / 3) and H = sum (sum |e_i| beta_i / 4) / sum (A / 3),
    the sums being over the vertex and its neighbours, beta_i signed.

    Parameters
    ----------
    disk : Disk
        A vertex and its neighbours.
    cells : (3, 1 + n)
        At the vertex and each neighbour, the integrals of K and H over the cell of its closed
        one-ring, and its area.
    rings : {1, 2, 3}
        How many rings of neighbours.
    radius : length, optional
        Instead of `rings`, the neighbours within this distance.

    Returns
    -------
    K, H : float
        Pointwise, in 1/length^2 and 1/length, H > 0 where the surface bends away from its normal.
        NaN: needs a closed one-ring at the vertex or a neighbour. Vertices without one are left out
        of the sums, so that those on a boundary have the values of the cells beside it; out of that
        of H, vertices where two facets fold onto each other (`curvlib.kit.ring.beta`).

    Notes
    -----
    The cells cover a closed mesh once. Over all of them the integrals of K sum up to 2 pi times the
    Euler characteristic, and those of H to the total mean curvature of Steiner's formula. What the
    deficit at a vertex has too much, those beside it have too little: the mean over many cells is
    off by less than one cell.

    Order: O(h^2) at valence 6 where e_i + e_{i+2} = e_{i+1}, as on a grid cut along one diagonal.
    On other rings the error does not vanish for a number of rings, but is smaller than over one
    cell: on spheres by marching cubes a fifth, a tenth and a sixteenth over 1, 2 and 3 rings. In a
    ball of radius r the values converge to means over it, O(r^2) off (Cohen-Steiner and Morvan
    2003).

    Source: Surazhsky et al. (2003), section 3.3; Cohen-Steiner, Morvan (2003), Restricted Delaunay
    triangulations and normal cycle, for the sums over a ball.
    """
    K = H = area = area_of_edges = 0.0
    for i in range(1 + disk.count):
        deficit, edges, cell = cells[0, i], cells[1, i], cells[2, i]
        if math.isfinite(deficit):
            K, area = K + deficit, area + cell
        if math.isfinite(edges):
            H, area_of_edges = H + edges, area_of_edges + cell
    return K / area, H / area_of_edges
