"""Values that a function of a disk is given and returns: a field at the vertices of the disk; and
Curvatures, ten numbers that are scattered to the arrays of a mesh."""

import numpy as np

from curvlib.kit.batch import settled
from curvlib.kit.compiled import kernel
from curvlib.kit.lanes import LANES

# Which of the six Curvatures are returned, and their ten numbers, where there is no disk.
NONE, UNDEFINED = (False,) * 6, (np.nan,) * 10


@kernel
def padded(count):
    """One and the next multiple of LANES."""
    return 1 + (count + LANES - 1) // LANES * LANES


@kernel
def scatter(values, start, end, unit, given, out):
    """Scatter the values of a block, in the unit of the mesh.

    One quantity after the other: the pages of ten arrays fall into the same cache sets.
    """
    for v in range(start, end if given[0] else start):
        out.K[v] = settled(values[v - start, 0], unit, 2)
    for v in range(start, end if given[1] else start):
        out.H[v] = settled(values[v - start, 1], unit, 1)
    for v in range(start, end if given[2] else start):
        out.k1[v] = settled(values[v - start, 2], unit, 1)
    for v in range(start, end if given[3] else start):
        out.k2[v] = settled(values[v - start, 3], unit, 1)
    for v in range(start, end if given[4] else start):
        for c in range(3):
            out.d1[v, c] = settled(values[v - start, 4 + c], unit, 0)
    for v in range(start, end if given[5] else start):
        for c in range(3):
            out.d2[v, c] = settled(values[v - start, 7 + c], unit, 0)


@kernel
def numbers(K=None, H=None, k1=None, k2=None, d1=None, d2=None):
    """Ten numbers, NaN for None."""
    nan = (np.nan, np.nan, np.nan)
    x = nan if d1 is None else (d1[0], d1[1], d1[2])
    y = nan if d2 is None else (d2[0], d2[1], d2[2])
    return (
        np.nan if K is None else K,
        np.nan if H is None else H,
        np.nan if k1 is None else k1,
        np.nan if k2 is None else k2,
        *x,
        *y,
    )


@kernel
def returns(K=None, H=None, k1=None, k2=None, d1=None, d2=None):
    """Which of the values are not None."""
    return (
        K is not None,
        H is not None,
        k1 is not None,
        k2 is not None,
        d1 is not None,
        d2 is not None,
    )
