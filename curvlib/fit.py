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

    `columns`: three arrays (rows, m) or broadcastable to it; `z`: (rows, m). Singular values
    are cut off relative to the largest, at CUTOFF, so that a direction which the rows leave
    undetermined contributes nothing. Not-a-number in gives not-a-number out.
    """
    rest = np.array(np.broadcast_arrays(*columns, z))
    R = np.zeros((3, 4, z.shape[-1]))
    product = np.empty_like(rest[0])
    for i in range(3):
        q = rest[i]
        np.sqrt(np.einsum("rm,rm->m", q, q), out=R[i, i])
        q /= np.where(R[i, i] > 0, R[i, i], 1)
        for j in range(i + 1, 4):
            np.einsum("rm,rm->m", q, rest[j], out=R[i, j])
            if i < 2:  # what then is left of z is asked for no more
                rest[j] -= np.multiply(R[i, j], q, out=product)
    R, y = R[:, :3], R[:, 3]

    # |det R| / |R|^3 bounds the smallest singular value over the largest from below: only
    # where that bound is too weak do singular values have to be looked at.
    squares = np.einsum("ijm,ijm->m", R, R)
    weak = ~(np.abs(R[0, 0] * R[1, 1] * R[2, 2]) > CUTOFF * squares * np.sqrt(squares))
    with np.errstate(divide="ignore", invalid="ignore"):
        x2 = y[2] / R[2, 2]
        x1 = (y[1] - R[1, 2] * x2) / R[1, 1]
        x0 = (y[0] - R[0, 1] * x1 - R[0, 2] * x2) / R[0, 0]
    x = np.array([x0, x1, x2])
    if weak.any():
        x[:, weak] = _truncated(R[:, :, weak], y[:, weak])
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
