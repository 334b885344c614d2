"""Linear least squares with three unknowns, for batches of small systems.

Modified Gram-Schmidt with the right-hand side as a fourth column: as stable as Householder's
QR, and the condition number is not squared as by normal equations.
"""

import math

import numpy as np

from .compiled import compiled

# A singular value below this fraction of the largest one counts as zero.
CUTOFF = 1e-6
SWEEPS = 8  # convergence is quadratic: of three columns, five leave rounding alone


@compiled
def least_squares(columns):
    """Minimum-norm x (3, m) that minimises |c_0 x_0 + c_1 x_1 + c_2 x_2 - c_3|.

    `columns`: c_0 to c_3, (4, rows, m), one system per entry of the last axis; overwritten.
    Singular values are cut off relative to the largest, at CUTOFF, so that a direction which
    the rows leave undetermined contributes nothing. Not-a-number in gives not-a-number out.
    """
    _, rows, m = columns.shape
    # R is the square root of D times U, whose diagonal is one: no column has to be scaled.
    D, U = np.zeros((3, m)), np.zeros((3, 4, m))
    for i in range(3):
        for row in range(rows):
            for k in range(m):
                D[i, k] += columns[i, row, k] * columns[i, row, k]
        for j in range(i + 1, 4):
            for row in range(rows):
                for k in range(m):
                    U[i, j, k] += columns[i, row, k] * columns[j, row, k]
            for k in range(m):
                U[i, j, k] /= D[i, k] if D[i, k] != 0 else 1.0
            for row in range(rows):
                for k in range(m):
                    columns[j, row, k] -= U[i, j, k] * columns[i, row, k]
    x = np.empty((3, m))
    for k in range(m):
        x[2, k] = U[2, 3, k]
        x[1, k] = U[1, 3, k] - U[1, 2, k] * x[2, k]
        x[0, k] = U[0, 3, k] - U[0, 1, k] * x[1, k] - U[0, 2, k] * x[2, k]
    for k in range(m):
        # |det R| / |R|^3 bounds the smallest singular value over the largest from below: only
        # where that bound is too weak do singular values have to be looked at.
        squares = D[0, k] * (1 + U[0, 1, k] ** 2 + U[0, 2, k] ** 2)
        squares += D[1, k] * (1 + U[1, 2, k] ** 2) + D[2, k]
        bound = D[0, k] / squares * (D[1, k] / squares) * (D[2, k] / squares)
        if not bound > CUTOFF**2:
            _truncated(D, U, k, x)
    return x


@compiled
def _truncated(D, U, k, x):
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
    x[:, k] = 0
    for j in range(3):
        # Below the cut-off: times zero, which leaves what is not a number as it is.
        inverse = 1 / squares[j] if squares[j] > CUTOFF**2 * largest else 0.0
        for i in range(3):
            x[i, k] += V[i, j] * (projections[j] * inverse)
