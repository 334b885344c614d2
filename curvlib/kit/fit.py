"""Linear least squares with three unknowns, for batches of small systems.

R = sqrt(D) U with diagonal D (3, m) and unit upper triangular U (3, 4, m), whose fourth column is
the right-hand side: no square roots in the loop. Modified Gram-Schmidt with an appended right-hand
side is as stable as Householder reflections, and does not square the condition number as normal
equations do.
"""

import math

import numpy as np

from .compiled import compiled

# In a fit to the neighbours of a vertex, singular values below this fraction of the largest count
# as zero. Rounding to float32 or to printed decimals gives a direction that no neighbour determines
# a singular value of up to 1e-4. Compared with 1e-6, 1e-3 changes one in a thousand errors of the
# study, all of circular fitting; 1e-2 changes errors on smooth meshes.
CUTOFF = 1e-3
SWEEPS = 8  # Jacobi converges quadratically: five reach rounding for three columns


@compiled
def least_squares(columns, cutoff):
    """Minimum-norm solutions of m systems: x minimises |c_0 x_0 + c_1 x_1 + c_2 x_2 - c_3|.

    Parameters
    ----------
    columns : (4, rows, m)
        c_0 to c_3, one system per entry of the last axis; overwritten.
    cutoff : float
        Singular values below this fraction of the largest count as zero: a direction that the
        rows do not determine contributes nothing.

    Returns
    -------
    (3, m)
        NaN for a system with a NaN.
    """
    D, U = _factors(columns)
    x = _back_substituted(D, U)
    for k in _weak(D, U, cutoff):
        _truncated(D, U, k, x, cutoff)
    return x


@compiled
def regression(columns, cutoff):
    """Least-squares solutions without a cut-off, and the systems that may need one.

    Parameters
    ----------
    columns : (4, rows, m)
        As in `least_squares`; overwritten.
    cutoff : float
        As in `least_squares`.

    Returns
    -------
    x : (3, m)
    weak : (w,) int
        Indices of the systems that may have a singular value below `cutoff` times the largest.
    """
    D, U = _factors(columns)
    return _back_substituted(D, U), _weak(D, U, cutoff)


@compiled
def fold(columns):
    """Replace each system by three rows with the same least-squares solution, R of its QR.

    Parameters
    ----------
    columns : (4, rows, m)
        As in `least_squares`; on return the first three rows hold R, the others zeros.
    """
    D, U = _factors(columns)
    _, rows, m = columns.shape
    for i in range(4):
        for row in range(rows):
            for k in range(m):
                columns[i, row, k] = 0.0
    for i in range(3):
        for k in range(m):
            scale = np.sqrt(D[i, k])
            columns[i, i, k] = scale
            for j in range(i + 1, 4):
                columns[j, i, k] = scale * U[i, j, k]


@compiled
def _factors(columns):
    """D and U of columns (4, rows, m), overwritten."""
    _, rows, m = columns.shape
    D, U = np.zeros((3, m)), np.zeros((3, 4, m))
    # One pass over the rows both orthogonalises to a column and sums products with the next.
    for row in range(rows):
        for k in range(m):
            a, b, c, z = (
                columns[0, row, k],
                columns[1, row, k],
                columns[2, row, k],
                columns[3, row, k],
            )
            D[0, k] += a * a
            U[0, 1, k] += a * b
            U[0, 2, k] += a * c
            U[0, 3, k] += a * z
    _divide(U[0, 1:], D[0])
    for row in range(rows):
        for k in range(m):
            a = columns[0, row, k]
            b = columns[1, row, k] - U[0, 1, k] * a
            c = columns[2, row, k] - U[0, 2, k] * a
            z = columns[3, row, k] - U[0, 3, k] * a
            columns[1, row, k], columns[2, row, k], columns[3, row, k] = b, c, z
            D[1, k] += b * b
            U[1, 2, k] += b * c
            U[1, 3, k] += b * z
    _divide(U[1, 2:], D[1])
    for row in range(rows):
        for k in range(m):
            b = columns[1, row, k]
            c = columns[2, row, k] - U[1, 2, k] * b
            z = columns[3, row, k] - U[1, 3, k] * b
            D[2, k] += c * c
            U[2, 3, k] += c * z
    _divide(U[2, 3:], D[2])
    return D, U


@compiled
def _back_substituted(D, U):
    x = np.empty_like(D)
    for k in range(x.shape[1]):
        x[2, k] = U[2, 3, k]
        x[1, k] = U[1, 3, k] - U[1, 2, k] * x[2, k]
        x[0, k] = U[0, 3, k] - U[0, 1, k] * x[1, k] - U[0, 2, k] * x[2, k]
    return x


@compiled
def _weak(D, U, cutoff):
    """The systems whose |det R| / |R|^3, a lower bound of the ratio of the smallest singular value
    to the largest, is not above the cut-off."""
    weak = np.empty(D.shape[1], np.bool_)
    for k in range(len(weak)):
        squares = D[0, k] * (1 + U[0, 1, k] ** 2 + U[0, 2, k] ** 2)
        squares += D[1, k] * (1 + U[1, 2, k] ** 2) + D[2, k]
        bound = D[0, k] / squares * (D[1, k] / squares) * (D[2, k] / squares)
        weak[k] = not bound > cutoff**2
    return np.flatnonzero(weak)


@compiled
def _divide(products, squares):
    """Divide products (j, m) with a column by its square (m,)."""
    for j in range(len(products)):
        for k in range(len(squares)):
            products[j, k] /= squares[k] if squares[k] != 0 else 1.0


@compiled
def _truncated(D, U, k, x, cutoff):
    """Set x[:, k] from the singular values of R above the cut-off.

    One-sided Jacobi (Hestenes 1958): rotations V make the columns of R V orthogonal; their lengths
    are the singular values.
    """
    R, V, y = np.zeros((3, 3)), np.eye(3), np.empty(3)
    for i in range(3):
        scale = math.sqrt(D[i, k])
        R[i, i], y[i] = scale, scale * U[i, 3, k]
        for j in range(i + 1, 3):
            R[i, j] = scale * U[i, j, k]
    for _ in range(SWEEPS):
        for p in range(2):
            for q in range(p + 1, 3):
                pp, pq, qq = 0.0, 0.0, 0.0
                for i in range(3):
                    pp += R[i, p] * R[i, p]
                    pq += R[i, p] * R[i, q]
                    qq += R[i, q] * R[i, q]
                if pq == 0:
                    continue
                half = (qq - pp) / (2 * pq)
                tangent = math.copysign(1.0, half) / (abs(half) + math.hypot(1.0, half))
                cosine = 1 / math.hypot(1.0, tangent)
                for i in range(3):
                    a, b = R[i, p], R[i, q]
                    R[i, p], R[i, q] = cosine * (a - tangent * b), cosine * (b + tangent * a)
                    a, b = V[i, p], V[i, q]
                    V[i, p], V[i, q] = cosine * (a - tangent * b), cosine * (b + tangent * a)
    squares, projections = np.zeros(3), np.zeros(3)
    for j in range(3):
        for i in range(3):
            squares[j] += R[i, j] * R[i, j]
            projections[j] += R[i, j] * y[i]
    largest = max(squares[0], squares[1], squares[2])
    x[0, k], x[1, k], x[2, k] = 0.0, 0.0, 0.0
    for j in range(3):
        # Below the cut-off times zero instead of skipped, so that NaN stays NaN.
        inverse = 1 / squares[j] if squares[j] > cutoff**2 * largest else 0.0
        for i in range(3):
            x[i, k] += V[i, j] * (projections[j] * inverse)
