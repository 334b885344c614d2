"""Whether the sweeps of `compact_hermite` converge, how fast, and what bounds that.

The unknowns of all vertices are x = b + M x. Sweeps converge from any start if and only if the
spectral radius of M is below 1.
"""

import numpy as np
import pandas as pd

from curvlib.estimators.compact_hermite import fitted
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
    """contraction.csv: of each of some meshes and degree the spectral `radius` of a sweep, its
    `norm`, the `bound`, the largest `gain` of a vertex (the Frobenius norm of its rows of M) and
    the part of the vertices that are `coupled`.

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
            squares = M.multiply(M).sum(axis=1).reshape(-1, 2).sum(1)
            row = {"surface": surface, "kind": kind, "n": n, "degree": degree}
            row |= {"radius": radius(M), "norm": norm(M), "bound": bound(M)}
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
