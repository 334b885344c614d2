"""Gauss-Bonnet scheme (angle deficit), section 3.3."""

import math
from typing import Literal

from curvlib.kit.compiled import compiled
from curvlib.kit.ring import beta, following, mixed_area, total, total_angle, weighted_total

LABEL = "Gauss-Bonnet"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#0072B2", "marker": "s", "linestyle": "-"}


@compiled
def estimate(
    ring,
    area: Literal["third", "half", "mixed"] = "third",
    dihedral: Literal["signed", "unsigned", "as-printed"] = "signed",
):
    """K by (3.12), H by (3.13).

    `area="half"` divides (3.12) by A/2 as printed, and (3.13) by A/3 all the same.
    `dihedral="as-printed"` multiplies |e_i| with the plain angle between N_i and N_{i+1}, which
    is that of the next edge.
    """
    A = total(ring.areas)
    mixed, half, signed = area == "mixed", area == "half", dihedral == "signed"
    cell = mixed_area(ring) if mixed else A
    angles = beta(ring)
    if dihedral == "as-printed":
        angles = following(angles)
    if not signed:
        for i in range(len(angles)):
            for k in range(angles.shape[1]):
                angles[i, k] = abs(angles[i, k])
    K, H = total_angle(ring), weighted_total(ring.lengths, angles)
    for k in range(len(K)):
        cell_k = cell[k] if mixed else A[k] / 3
        K[k] = (2 * math.pi - K[k]) / (A[k] / 2 if half else cell_k)
        H[k] /= 4 * cell_k
    return K, H
