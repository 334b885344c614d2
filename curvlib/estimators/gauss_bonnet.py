"""Gauss-Bonnet scheme (angle deficit), section 3.3."""

from typing import Literal

import numpy as np

from curvlib.kit.ring import beta, following, mixed_area, total, total_angle, weighted_total

LABEL = "Gauss-Bonnet"
SOURCE = "https://doi.org/10.1109/ROBOT.2003.1241726"
STYLE = {"color": "#0072B2", "marker": "s", "linestyle": "-"}


def estimate(
    ring,
    area: Literal["third", "half", "mixed"] = "third",
    dihedral: Literal["signed", "unsigned", "as-printed"] = "signed",
):
    """K = (2 pi - sum alpha_i) / (A / 3) (3.12) and H = sum |e_i| beta_i / (4 A / 3) (3.13).

    Parameters
    ----------
    ring : Ring
        Batch of m closed one-rings of one valence n.
    area : {"third", "half", "mixed"}
        The cell of v: a third of the ring's area A, A/2 for K as printed (H keeps A/3), or the
        mixed Voronoi cell of Meyer et al. (2003).
    dihedral : {"signed", "unsigned", "as-printed"}
        beta_i: the signed angle between the facets at e_i, its absolute value, or the absolute
        angle at e_{i+1}.

    Returns
    -------
    K, H : ndarray, (m,)
        Pointwise, in 1/length^2 and 1/length, H > 0 where the surface bends away from its normal.
        NaN: needs a closed one-ring.

    Notes
    -----
    H is NaN where two facets fold onto each other (`curvlib.kit.ring.beta`).

    Order: O(h^2) for K at valence 6 where e_i + e_{i+2} = e_{i+1}, as on a grid cut along one
    diagonal; on other rings the error does not vanish (Borrelli, Cazals, Morvan 2003; Xu 2009).
    Measured on shrinking rings, H behaves likewise.

    Source: Surazhsky et al. (2003), section 3.3.

    Examples
    --------
    >>> import curvlib
    >>> octahedron = (
    ...     [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]],
    ...     [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    ...     + [[1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]],
    ... )
    >>> float(curvlib.estimate(octahedron, "gauss_bonnet", area="half").K[0].round(4))
    1.2092
    """
    A = total(ring.areas)
    cell = mixed_area(ring) if area == "mixed" else A / 3
    angles = beta(ring)
    if dihedral == "as-printed":
        angles = following(angles)
    if dihedral != "signed":
        angles = np.abs(angles)
    K = (2 * np.pi - total_angle(ring)) / (A / 2 if area == "half" else cell)
    return K, weighted_total(ring.lengths, angles) / (4 * cell)
