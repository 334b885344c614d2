"""Linear least squares with three unknowns, for batches of small systems.

Component-first: the columns of the design matrix are arrays (rows, m), one system per entry
of the last axis. Modified Gram-Schmidt with the right-hand side as a fourth column: as stable
as Householder's QR, and the condition number is not squared as by normal equations.
"""

import numpy as np

# A singular value below this fraction of the largest one counts as zero.
CUTOFF = 1e-6


def least_squares(columns, z):
    """Minimum-norm x (3, m) that minimises |c0 x0 + c1 x1 + c2 x2 - z|.

    `columns`: three arrays (rows, m); `z`: (rows, m). Singular values are cut off relative to
    the largest, at CUTOFF, so that a direction which the rows leave undetermined contributes
    nothing. Not-a-number in gives not-a-number out.
    """
    rest = [*columns, z]
    # R is the square root of D times U, whose diagonal is one: no column has to be scaled.
    D = np.empty((3, z.shape[-1]))
    U = np.zeros((3, 4, z.shape[-1]))
    for i in range(3):
        q = rest[i]
        np.einsum("rm,rm->m", q, q, out=D[i])
        U[i, i] = 1
        square = D[i] + (D[i] == 0)
        for j in range(i + 1, 4):
            np.einsum("rm,rm->m", q, rest[j], out=U[i, j])
            U[i, j] /= square
            if i < 2:  # what then is left of z is asked for no more
                part = U[i, j] * q
                rest[j] = np.subtract(rest[j], part, out=part)
    x2 = U[2, 3]
    x1 = U[1, 3] - U[1, 2] * x2
    x0 = U[0, 3] - U[0, 1] * x1 - U[0, 2] * x2
    x = np.array([x0, x1, x2])

    # |det R| / |R|^3 bounds the smallest singular value over the largest from below: only
    # where that bound is too weak do singular values have to be looked at.
    squares = D[0] * (1 + U[0, 1] ** 2 + U[0, 2] ** 2) + D[1] * (1 + U[1, 2] ** 2) + D[2]
    with np.errstate(divide="ignore", invalid="ignore"):
        weak = ~(D[0] / squares * (D[1] / squares) * (D[2] / squares) > CUTOFF**2)
    if weak.any():
        R = np.sqrt(D[:, None, weak]) * U[:, :, weak]
        x[:, weak] = _truncated(R[:, :3], R[:, 3])
    return x


def _truncated(R, y):
    """Minimum-norm solution of R x = y, R (3, 3, m), by singular values above the cut-off."""
    x = np.full_like(y, np.nan)
    finite = np.isfinite(R).all((0, 1)) & np.isfinite(y).all(0)
    u, s, vt = np.linalg.svd(np.moveaxis(R[:, :, finite], -1, 0))
    keep = s > CUTOFF * s[:, :1]
    inverse = np.where(keep, 1 / np.where(keep, s, 1), 0)
    x[:, finite] = np.einsum("mji,mj,mkj,km->im", vt, inverse, u, y[:, finite])
    return x
