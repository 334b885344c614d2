"""Gauss-Bonnet scheme (angle deficit), section 3.3."""

import math
from typing import Literal

import numpy as np

from curvlib.ring import following

LABEL = "Gauss-Bonnet"
STYLE = {"color": "#0072B2", "marker": "s", "linestyle": "-"}


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
    cell = ring.mixed_area if area == "mixed" else ring.A / 3
    beta = ring.beta if dihedral == "signed" else abs(ring.beta)
    if dihedral == "as-printed":
        beta = following(beta)
    K = (2 * math.pi - ring.total_angle) / (ring.A / 2 if area == "half" else cell)
    H = np.einsum("nm,nm->m", ring.lengths, beta) / (4 * cell)
    return K, H
