"""Whether the sweeps of `compact_hermite` converge, how fast, and what bounds that.

The unknowns of all vertices are x = b + M x. Sweeps converge from any start if and only if the
spectral radius of M is below 1.
"""

from typing import Literal

import numpy as np
import pandas as pd

from curvlib.estimators.compact_hermite import fitted
from curvlib.estimators.compact_hermite import normals as normals
from curvlib.kit.compiled import kernel
from curvlib.kit.vectors import at, dot, tangents
from curvlib.passes import Passes

# Steps of power iterations; the norm of the last WINDOW of them gives the rate.
STEPS, WINDOW = 200, 60


def system(mesh, function=fitted, threads: int = 1, **options):
    """The matrix M (2 V, 2 V), the map F (3 V, 2 V) to second derivatives and the values (5, V)
    where unknowns are zero, of a function that returns Coupled; of `compact_hermite` by default.

    Returns
    -------
    M, F : scipy.sparse.csr_array
    own : (5, V)
        p, q, r, s and t.
    """
    from scipy.sparse import csr_array

    blocks, own = Passes(mesh, threads).equations(function, **options)
    count = len(mesh.vertices)
    rows = np.concatenate(
        [
            block.start + np.repeat(np.arange(len(block.offsets) - 1), np.diff(block.offsets))
            for block in blocks
        ]
    )
    columns = np.concatenate([block.neighbours for block in blocks])

    def matrix(values, height):
        """Values (n, 2 height): row by row of a block (height, 2) of each neighbour."""
        values = values.astype(float).reshape(-1, height, 2)
        i = (height * rows)[:, None, None] + np.arange(height)[None, :, None]
        j = (2 * columns)[:, None, None] + np.arange(2)[None, None]
        i, j = np.broadcast_to(i, values.shape).ravel(), np.broadcast_to(j, values.shape).ravel()
        return csr_array((values.ravel(), (i, j)), (height * count, 2 * count))

    M = matrix(np.concatenate([block.near for block in blocks]), 2)
    return M, matrix(np.concatenate([block.far for block in blocks]), 3), own[:5]


def radius(M, seed: int = 0) -> float:
    """The spectral radius of M by power iteration: the mean rate of growth over the last steps,
    which a pair of complex eigenvalues does not disturb."""
    x = np.random.default_rng(seed).standard_normal(M.shape[1])
    logarithms = []
    for _ in range(STEPS):
        x = M @ x
        size = np.linalg.norm(x)
        if size == 0:
            return 0.0
        logarithms.append(np.log(size))
        x /= size
    return float(np.exp(np.mean(logarithms[-WINDOW:])))


def norm(M, seed: int = 0) -> float:
    """The largest singular value of M, by power iteration of M^T M."""
    x = np.random.default_rng(seed).standard_normal(M.shape[1])
    for _ in range(STEPS):
        x = M.T @ (M @ x)
        x /= np.linalg.norm(x)
    return float(np.linalg.norm(M @ x))


@kernel
def moments(disk, normals, rings: Literal[2] = 2):
    """Means of x^2, x y and y^2 over the neighbours of a vertex, in the frame of its unknowns, in
    units of the disk's radius."""
    N = at(normals, 0)
    X, Y = tangents(N)
    xx, xy, yy, over = 0.0, 0.0, 0.0, 1 / (disk.count * disk.radius * disk.radius)
    for i in range(disk.count):
        e = disk.e[0, i], disk.e[1, i], disk.e[2, i]
        x, y = dot(e, X), dot(e, Y)
        xx, xy, yy = xx + x * x * over, xy + x * y * over, yy + y * y * over
    return xx, xy, yy


def in_whitened(M, mesh, threads: int = 1):
    """D M D^-1: M for unknowns along the axes in which the second moments of the neighbours of each
    vertex are round. Its spectral radius is that of M; its norms do not see that a mesh is
    stretched."""
    from scipy.sparse import block_diag

    xx, xy, yy = Passes(mesh, threads).field(moments)
    a = np.sqrt(xx)
    b, c = xy / a, np.sqrt(yy - (xy / a) ** 2)
    # Slopes along the axes of L, moments being L L^T, are L^T times those along the frame.
    D = np.moveaxis(np.array([[a, b], [0 * a, c]]) / np.sqrt(a * c), 2, 0)
    left, right = block_diag(D, format="csr"), block_diag(np.linalg.inv(D), format="csr")
    return left @ M @ right


def bound(M) -> float:
    """An upper bound of the spectral radius that holds whatever the rounding of its iteration.

    Notes
    -----
    Let A have for each block (2, 2) of M its spectral norm. For any w > 0 the largest
    (A w)_v / w_v bounds the spectral radius of A (Collatz, Wielandt), and so that of M: it is the
    norm of M in the norm max |x_v| / w_v. w comes from power iteration of A, which makes the bound
    that of A itself.
    """
    from scipy.sparse import csr_array

    blocks = M.tobsr((2, 2))
    a, b, c, d = blocks.data.reshape(-1, 4).T
    squares, determinant = a * a + b * b + c * c + d * d, a * d - b * c
    largest = np.sqrt((squares + np.sqrt(np.maximum(squares**2 - 4 * determinant**2, 0))) / 2)
    A = csr_array((largest, blocks.indices, blocks.indptr), (M.shape[0] // 2, M.shape[1] // 2))
    # Irreducible, by little, so that w stays positive at vertices whose equations are empty.
    w, least = np.ones(A.shape[0]), np.inf
    for _ in range(STEPS):
        after = A @ w
        least = min(least, float((after / w).max()))
        w = after + 1e-3 * w.max()
        w /= w.max()
    return least


def contraction(meshes, threads: int = 1) -> pd.DataFrame:
    """contraction.csv: of each of some meshes and degree the spectral `radius` of a sweep; in
    whitened coordinates its `norm`, the `bound` and the largest `gain` of a vertex (the Frobenius
    norm of its rows); the part of the vertices that are `coupled`.

    Parameters
    ----------
    meshes : dict
        (surface, kind, n) -> Mesh.
    threads : int
    """
    rows = []
    for (surface, kind, n), mesh in meshes.items():
        for degree in (6, 5, 4):
            M, _, _ = system(mesh, threads=threads, degree=degree)
            row = {"surface": surface, "kind": kind, "n": n, "degree": degree}
            whitened = in_whitened(M, mesh, threads)
            row |= {"radius": radius(M), "norm": norm(whitened), "bound": bound(whitened)}
            squares = whitened.multiply(whitened).sum(axis=1).reshape(-1, 2).sum(1)
            row |= {"gain": np.sqrt(squares.max()), "coupled": (squares > 0).mean()}
            rows.append(row)
    return pd.DataFrame(rows)


def sweeps(mesh, counts, threads: int = 1, **options) -> pd.DataFrame:
    """The mean errors of K and H after numbers of sweeps, over the vertices that are not on the
    boundary; after 0 the polynomials have the slopes of the first normals.

    Parameters
    ----------
    mesh : Mesh
        With exact K and H.
    counts : sequence of int
    threads : int
    **options
        Of `compact_hermite`.

    Returns
    -------
    DataFrame
        `sweeps`, `quantity`, `value`, and the `change`: the root mean square of the last change of
        an unknown over that of the first.
    """
    M, F, own = system(mesh, threads=threads, **options)
    b, inner, rows = own[:2].T.ravel(), ~mesh.boundary, []
    x, first, change = np.zeros_like(b), np.linalg.norm(b), np.nan
    for count in range(max(counts) + 1):
        if count in counts:
            (p, q), (r, s, t) = x.reshape(-1, 2).T, own[2:] + (F @ x).reshape(-1, 3).T
            g = 1 + p * p + q * q
            K = (r * t - s * s) / g**2
            H = -((1 + q * q) * r - 2 * p * q * s + (1 + p * p) * t) / (2 * g**1.5)
            for name, found, exact in (("K", K, mesh.K), ("H", H, mesh.H)):
                error = np.nanmean(np.abs(found - exact)[inner])
                rows.append({"sweeps": count, "quantity": name, "value": error, "change": change})
        after = b + M @ x
        change, x = np.linalg.norm(after - x) / first, after
    return pd.DataFrame(rows)
