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
    x, bounds = _back_substituted(D, U), _bounds(D, U)
    for k in range(len(bounds)):
        if not bounds[k] > cutoff**2:
            _truncated(D, U, k, x, cutoff)
    return x


@compiled
def regression(columns):
    """Least-squares solutions without a cut-off, and how well the systems determine them.

    Parameters
    ----------
    columns : (4, rows, m)
        As in `least_squares`; overwritten.

    Returns
    -------
    x : (3, m)
    bounds : (m,)
        Lower bounds of the square of the smallest singular value over the largest.
    """
    D, U = _factors(columns)
    return _back_substituted(D, U), _bounds(D, U)


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
    for j in range(4):
        for i in range(3):
            for k in range(m):
                columns[j, i, k] = math.sqrt(D[i, k]) * U[i, j, k]
        for row in range(3, rows):
            for k in range(m):
                columns[j, row, k] = 0.0


@compiled
def _factors(columns):
    """D and U of columns (4, rows, m), overwritten."""
    _, rows, m = columns.shape
    D, U = np.empty((3, m)), np.empty((3, 4, m))
    for i in range(3):
        for k in range(m):
            D[i, k] = 0.0
        for j in range(4):
            for k in range(m):
                U[i, j, k] = 1.0 if i == j else 0.0
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
    _divide(U, D, 0)
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
    _divide(U, D, 1)
    for row in range(rows):
        for k in range(m):
            b = columns[1, row, k]
            c = columns[2, row, k] - U[1, 2, k] * b
            z = columns[3, row, k] - U[1, 3, k] * b
            D[2, k] += c * c
            U[2, 3, k] += c * z
    _divide(U, D, 2)
    return D, U


@compiled
def _back_substituted(D, U):
    x = np.empty(D.shape)
    for k in range(D.shape[1]):
        x[2, k] = U[2, 3, k]
        x[1, k] = U[1, 3, k] - U[1, 2, k] * x[2, k]
        x[0, k] = U[0, 3, k] - U[0, 1, k] * x[1, k] - U[0, 2, k] * x[2, k]
    return x


@compiled
def _bounds(D, U):
    """The square of |det R| / |R|^3, a lower bound of the smallest singular value over the
    largest."""
    bounds = np.empty(D.shape[1])
    for k in range(len(bounds)):
        squares = D[0, k] * (1 + U[0, 1, k] ** 2 + U[0, 2, k] ** 2)
        squares += D[1, k] * (1 + U[1, 2, k] ** 2) + D[2, k]
        bounds[k] = D[0, k] / squares * (D[1, k] / squares) * (D[2, k] / squares)
    return bounds


@compiled
def _divide(U, D, i):
    """Divide the products with column i by its square."""
    for j in range(i + 1, 4):
        for k in range(D.shape[1]):
            U[i, j, k] /= D[i, k] if D[i, k] != 0 else 1.0


@compiled
def _truncated(D, U, k, x, cutoff):
    """Set x[:, k] from the singular values of R above the cut-off.

    One-sided Jacobi (Hestenes 1958): rotations V make the columns of R V orthogonal; their lengths
    are the singular values.
    """
    R, V = np.empty((3, 4)), np.empty((3, 3))
    for i in range(3):
        scale = math.sqrt(D[i, k])
        for j in range(4):
            R[i, j] = scale * U[i, j, k]
        for j in range(3):
            V[i, j] = 1.0 if i == j else 0.0
    for _ in range(SWEEPS):
        for p in range(2):
            for q in range(p + 1, 3):
                pp, pq, qq = _product(R, p, p), _product(R, p, q), _product(R, q, q)
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
    largest = 0.0
    for j in range(3):
        square = _product(R, j, j)
        largest = square if square > largest else largest
    for i in range(3):
        x[i, k] = 0.0
    for j in range(3):
        square = _product(R, j, j)
        # Below the cut-off times zero instead of skipped, so that NaN stays NaN.
        inverse = 1 / square if square > cutoff**2 * largest else 0.0
        projection = _product(R, j, 3) * inverse
        for i in range(3):
            x[i, k] += V[i, j] * projection


@compiled
def _product(R, p, q):
    """The dot product of two columns of R (3, 4)."""
    return R[0, p] * R[0, q] + R[1, p] * R[1, q] + R[2, p] * R[2, q]
