"""Gauss-Bonnet scheme (angle deficit), section 3.3."""

import math
from typing import Literal

LABEL = "Gauss-Bonnet"
STYLE = {"color": "#0072B2", "marker": "s", "linestyle": "-"}


def estimate(
    ring,
    area: Literal["third", "half", "mixed"] = "third",
    dihedral: Literal["signed", "unsigned"] = "signed",
):
    """K by (3.12), H by (3.13).

    `area="half"` divides (3.12) by A/2 as printed, and (3.13) by A/3 all the same.
    """
    cell = ring.mixed_area if area == "mixed" else ring.A / 3
    beta = ring.beta if dihedral == "signed" else abs(ring.beta)
    K = (2 * math.pi - ring.sum_of_alpha) / (ring.A / 2 if area == "half" else cell)
    H = (ring.lengths * beta).sum(0) / (4 * cell)
    return K, H
