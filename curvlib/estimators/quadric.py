"""q"""

from typing import Literal

from curvlib.kit.compiled import kernel
from curvlib.kit.polynomial import fit_polynomial
from curvlib.kit.tensor import from_graph
from curvlib.kit.vectors import tangents

LABEL = "Quadric"


@kernel
def estimate(disk, rings: Literal[2, 1, 3] = 2):
    X, Y = tangents(disk.normal)
    derivatives, _ = fit_polynomial(disk, X, Y, 1, 2)
    return from_graph(*derivatives, X, Y, disk.normal)[0]
