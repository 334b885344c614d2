"""A prototype past `compact_hermite`: normals and second derivatives of all vertices as unknowns.

Not an estimator: it keeps a matrix for each vertex, has no guard, and is for closed meshes.
"""

import numpy as np

from curvlib.estimation import estimate

RINGS = 2
# Weights of slopes and of second derivatives beside heights, in whitened coordinates.
SLOPE, SECOND = 0.1, 0.01
# Powers of the derivatives and weights that make the sum of squares that of the Hessian.
SECONDS = ((2, 0), 1.0), ((1, 1), 2**0.5), ((0, 2), 1.0)
BLOCK = 1000  # vertices whose matrices are made at a time
TOLERANCE, SWEEPS = 1e-6, 60


def hessians(mesh, degree: int = 8, slope: float = SLOPE, second: float = SECOND, threads=1):
    """K and H (V,) of polynomials of some degree through each vertex of a closed mesh, fitted over
    two rings to the heights, slopes and second derivatives of its neighbours, which are those of
    their own polynomials; and the changes (n,) of the curvature tensors by sweep, relative to the
    first.

    Notes
    -----
    Each vertex has the frame X, Y, Z of its first normal, that of a jet of degree 3. In it a
    neighbour of normal N and curvature tensor S, of the last sweep, has the slopes
    p = -(N . X) / (N . Z) and q, and second derivatives such as -g (X + p Z) S (Y + q Z),
    g = sqrt(1 + p^2 + q^2). Residuals of heights have the weight 1.
    """
    found = estimate(mesh, "jet", threads, degree=3, rings=2)
    N, S = _normals(found), _tensors(found)
    points, near, there = mesh.vertices, *_stencils(mesh)
    X, Y = _tangents(N)
    Z, frame = N, np.stack((X, Y, N), 1)
    local = np.einsum("vij,vnj->vni", frame, points[near] - points[:, None])
    x, y, height = np.where(there[..., None], local, 0).transpose(2, 0, 1)
    axes = _whitening(x, y, there.sum(1))
    maps = _maps(x, y, axes, there, degree, slope, second)
    changes = []
    for _ in range(SWEEPS):
        normals, tensors = N[near], S[near]
        p, q = (
            -np.einsum("vnj,vj->vn", normals, a) / np.einsum("vnj,vj->vn", normals, Z)
            for a in (X, Y)
        )
        along = X[:, None] + p[..., None] * Z[:, None], Y[:, None] + q[..., None] * Z[:, None]
        g = np.sqrt(1 + p * p + q * q)
        rr, ss, tt = (
            -g * np.einsum("vni,vnij,vnj->vn", along[i], tensors, along[j])
            for i, j in ((0, 0), (0, 1), (1, 1))
        )
        data = _data(height, p, q, rr, ss, tt, axes, there, slope, second)
        f = _turned(np.einsum("vkn,vn->vk", maps, data), axes)
        before = S
        N, S, K, H = _surface(f, X, Y, Z)
        changes.append(np.sqrt(((S - before) ** 2).sum((1, 2)).mean()))
        if changes[-1] < TOLERANCE * changes[0] or not np.isfinite(changes[-1]):
            break
    return K, H, np.array(changes) / changes[0]


def _normals(found):
    return np.cross(found.d1, found.d2)


def _tensors(found):
    return sum(
        k[:, None, None] * d[:, :, None] * d[:, None]
        for k, d in ((found.k1, found.d1), (found.k2, found.d2))
    )


def _tangents(N):
    """Two unit vectors (V, 3) that make a right-handed frame with N."""
    axis = np.eye(3)[np.abs(N).argmin(1)]
    X = np.cross(axis, N)
    X /= np.linalg.norm(X, axis=1)[:, None]
    return X, np.cross(N, X)


def _stencils(mesh):
    """Neighbours (V, n) over RINGS, padded with the vertex itself, and where there are any."""
    from scipy.sparse import coo_array, eye_array

    a, b = mesh.faces.ravel(), np.roll(mesh.faces, -1, axis=1).ravel()
    count = len(mesh.vertices)
    edges = coo_array((np.ones(len(a)), (a, b)), (count, count)).tocsr()
    step = edges + edges.T + eye_array(count)
    near = step
    for _ in range(RINGS - 1):
        near = near @ step
    near = (near - near.multiply(eye_array(count))).tocsr()
    near.eliminate_zeros()
    near.sort_indices()
    sizes = np.diff(near.indptr)
    there = np.arange(sizes.max()) < sizes[:, None]
    index = np.repeat(np.arange(count)[:, None], sizes.max(), 1)
    index[there] = near.indices
    return index, there


def _whitening(x, y, count):
    """a, b, c of the coordinates a x and c x + b y whose second moments are half the identity."""
    xx, xy, yy = (2 * z.sum(1) / count for z in (x * x, x * y, y * y))
    l11 = np.sqrt(xx)
    l21 = xy / l11
    l22 = np.sqrt(yy - l21 * l21)
    return 1 / l11, 1 / l22, -l21 / (l11 * l22)


def _maps(x, y, axes, there, degree, slope, second):
    """The maps (V, 5, 6 n) from the data to the coefficients of xi, eta, xi^2, xi eta, eta^2."""
    a, b, c = (z[:, None] for z in axes)
    xi, eta = a * x, c * x + b * y
    powers = [(s - j, j) for s in range(1, degree + 1) for j in range(s + 1)]
    maps = np.empty((len(x), 5, 6 * x.shape[1]))
    for start in range(0, len(x), BLOCK):
        part = slice(start, start + BLOCK)
        u, v, inside = xi[part], eta[part], there[part]

        def column(i, j, u=u, v=v, inside=inside):
            """Of the monomial of powers i and j: values, slopes, second derivatives."""

            def term(m, n):
                factor = float(np.prod(range(i - m + 1, i + 1)) * np.prod(range(j - n + 1, j + 1)))
                return factor * u ** max(i - m, 0) * v ** max(j - n, 0) * inside

            first = slope * term(1, 0), slope * term(0, 1)
            curved = (second * w * term(*m) for m, w in SECONDS)
            return np.concatenate((term(0, 0), *first, *curved), 1)

        A = np.stack([column(i, j) for i, j in powers], 2)
        maps[part] = np.linalg.pinv(A, rcond=1e-12)[:, :5]
    return maps


def _data(height, p, q, r, s, t, axes, there, slope, second):
    """Heights, slopes and second derivatives (V, 6 n) along the whitened axes."""
    a, b, c = (z[:, None] for z in axes)
    # x = xi / a and y = (eta - c xi / a) / b.
    x_xi, y_xi, y_eta = 1 / a, -c / (a * b), 1 / b
    first = p * x_xi + q * y_xi, q * y_eta
    curved = (
        r * x_xi**2 + 2 * s * x_xi * y_xi + t * y_xi**2,
        (s * x_xi + t * y_xi) * y_eta,
        t * y_eta**2,
    )
    weighted = (second * w * z for z, (_, w) in zip(curved, SECONDS))
    rows = (height, *(slope * z for z in first), *weighted)
    return np.concatenate([np.where(there, z, 0) for z in rows], 1)


def _turned(f, axes):
    """p, q, r, s and t (V,) of coefficients (V, 5) along the whitened axes."""
    (a, b, c), (u, v, uu, uv, vv) = axes, f.T
    uu, vv = 2 * uu, 2 * vv
    return (
        a * u + c * v,
        b * v,
        a * a * uu + 2 * a * c * uv + c * c * vv,
        a * b * uv + b * c * vv,
        b * b * vv,
    )


def _surface(f, X, Y, Z):
    """Normals, curvature tensors, K and H of graphs above the vertices."""
    p, q, r, s, t = f
    g = np.sqrt(1 + p * p + q * q)
    N = (Z - p[:, None] * X - q[:, None] * Y) / g[:, None]
    # The dual basis of (X + p Z, Y + q Z) in the tangent plane.
    one, two = X + p[:, None] * Z, Y + q[:, None] * Z
    area = np.cross(one, two)
    length = (area**2).sum(1)[:, None]
    A, B = np.cross(two, area) / length, np.cross(area, one) / length
    S = -sum(
        (z / g)[:, None, None] * (u[:, :, None] * w[:, None] + w[:, :, None] * u[:, None]) / 2
        for z, u, w in ((r, A, A), (2 * s, A, B), (t, B, B))
    )
    K = (r * t - s * s) / g**4
    H = -((1 + q * q) * r - 2 * p * q * s + (1 + p * p) * t) / (2 * g**3)
    return N, S, K, H
