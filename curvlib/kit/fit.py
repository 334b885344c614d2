"""Linear least squares with three unknowns, for batches of small systems.

R of a QR decomposition is kept as sqrt(D) U, with D (3, m) diagonal and U (3, 4, m) of unit
diagonal, whose fourth column is the right-hand side. Modified Gram-Schmidt is as stable with that
as Householder's reflections, and the condition number is not squared as by normal equations.
"""

import math

import numpy as np

from .compiled import compiled

# Singular values below this fraction of the largest count as zero in a fit to the neighbours of a
# vertex. The rounding of float32 files and of printed decimals makes up to 1e-4 of a direction
# that no neighbour determines; 1e-2 changes errors on smooth meshes.
CUTOFF = 1e-3
SWEEPS = 8  # convergence is quadratic: of three columns, five leave rounding alone


@compiled
def least_squares(columns, cutoff):
    """Minimum-norm x (3, m) that minimises |c_0 x_0 + c_1 x_1 + c_2 x_2 - c_3|.

    NaN in a system makes its solution NaN.

    Parameters
    ----------
    columns : (4, rows, m)
        c_0 to c_3, one system per entry of the last axis; overwritten.
    cutoff : float
        Singular values below this fraction of the largest count as zero, so that a direction
        which the rows leave undetermined contributes nothing.
    """
    D, U = _factors(columns)
    x = _back_substituted(D, U)
    for k in _weak(D, U, cutoff):
        _truncated(D, U, k, x, cutoff)
    return x


@compiled
def regression(columns, cutoff):
    """The solution x (3, m) as by `least_squares` without a cut-off, and the indices of the systems
    that may have a singular value below `cutoff` times the largest."""
    D, U = _factors(columns)
    return _back_substituted(D, U), _weak(D, U, cutoff)


@compiled
def fold(columns):
    """Replace each system of columns (4, rows, m) by three rows, at the beginning, that have the
    same least-squares solution, and zeros."""
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
    """D and U of columns (4, rows, m), which are overwritten."""
    _, rows, m = columns.shape
    D, U = np.zeros((3, m)), np.zeros((3, 4, m))
    # Products with a column are summed while the columns before it are taken out.
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
    """The systems that |det R| / |R|^3, a lower bound of the smallest singular value over the
    largest, does not show to be above the cut-off."""
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
    """Sets x[:, k] from the singular values of R above the cut-off.

    Rotations of pairs of columns make R V orthogonal (one-sided Jacobi: Hestenes 1958), and its
    columns as long as the singular values.
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
        # Times zero below the cut-off, which keeps NaN.
        inverse = 1 / squares[j] if squares[j] > cutoff**2 * largest else 0.0
        for i in range(3):
            x[i, k] += V[i, j] * (projections[j] * inverse)
