"""Gauss-Bonnet scheme (angle deficit), section 3.3."""

import math
from typing import Literal

import numpy as np

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
    cell = mixed_area(ring) if area == "mixed" else A / 3
    angles = beta(ring) if dihedral == "signed" else np.abs(beta(ring))
    if dihedral == "as-printed":
        angles = following(angles)
    K = (2 * math.pi - total_angle(ring)) / (A / 2 if area == "half" else cell)
    H = weighted_total(ring.lengths, angles) / (4 * cell)
    return K, H
