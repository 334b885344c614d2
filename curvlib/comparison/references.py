"""What estimators are measured against: the fit of CGAL, in compiled code of this package, and
numbers that were measured elsewhere."""

from pathlib import Path
from typing import Literal

import numpy as np

from curvlib.kit.compiled import compiled
from curvlib.kit.polynomial import fit_polynomial
from curvlib.kit.tensor import from_graph
from curvlib.kit.vectors import dot, tangents

# A row per number, with its source.
ELSEWHERE = Path(__file__).with_name("measured-elsewhere.csv")


@compiled
def principal_axes(disk, degree: Literal[4, 2] = 4, rings: Literal[3, 2] = 3):
    """The jet of CGAL's Monge_via_jet_fitting: all points of weight 1, the vertex among them, in
    the frame of their principal axes. Its K, H, k1, k2, d1 and d2 are CGAL's to 1e-9.

    Parameters
    ----------
    disk : Disk
    degree : {4, 2}
    rings : {3, 2}

    Returns
    -------
    Curvatures
    """
    n = disk.count
    points = np.zeros((3, n + 1))
    points[:, 1:] = disk.e[:, :n]
    for c in range(3):
        points[c] -= points[c].mean()
    _, axes = np.linalg.eigh(points @ points.T)
    N = (axes[0, 0], axes[1, 0], axes[2, 0])
    if dot(N, disk.normal) < 0:
        N = (-N[0], -N[1], -N[2])
    X, Y = tangents(N)
    return from_graph(*fit_polynomial(disk, X, Y, N, 0, degree)[0], X, Y, N)[0]
