"""Meshes with noise: vertices displaced by random amounts, reproducibly."""

import numpy as np

from curvlib.errors import check_name

# Part of the vertices that outliers are, and how many mean edges they lie off.
PART, FAR = 0.005, 5.0
# Sweeps of means over neighbours that correlate noise.
SWEEPS = 3

KINDS = {
    "white": "normal deviates along the normals",
    "isotropic": "normal deviates in all directions",
    "uneven": "white noise that grows along x, from none to twice the level",
    "half": "white noise where x is above its median",
    "correlated": "white noise averaged over neighbours, brought back to the level",
    "quantised": "coordinates rounded to multiples of the level",
    "outliers": "white noise, and one vertex of 200 lies 5 mean edges off, on either side",
    "float32": "coordinates in single precision",
}


def noisy(mesh, kind: str, level: float, seed: int):
    """A mesh with noise.

    Parameters
    ----------
    mesh : Mesh
        With normals.
    kind : str
        One of KINDS.
    level : float
        Standard deviation, or step of "quantised", in mean edges; "float32" has none.
    seed : int

    Returns
    -------
    Mesh
        With the same faces, without normals and exact values.

    Raises
    ------
    InputError
        The kind is unknown.

    Examples
    --------
    >>> from curvlib.meshes.jittered import jittered
    >>> mesh = jittered("patch", 8)
    >>> moves = noisy(mesh, "quantised", 0.1, seed=1).vertices - mesh.vertices
    >>> bool((abs(moves) <= 0.05 * mesh.mean_edge + 1e-12).all())
    True
    """
    check_name("kind of noise", kind, KINDS)
    rng, length = np.random.default_rng(seed), mesh.mean_edge
    count, step = len(mesh.vertices), level * mesh.mean_edge
    vertices = np.array(mesh.vertices)
    if kind == "quantised":
        return mesh.moved(np.round(vertices / step) * step if step else vertices)
    if kind == "float32":
        return mesh.moved(vertices.astype(np.float32))
    if kind == "isotropic":
        return mesh.moved(vertices + step * rng.standard_normal((count, 3)))
    deviates = rng.standard_normal(count)
    x = vertices[:, 0]
    if kind == "correlated":
        deviates = _correlated(mesh, deviates)
    elif kind == "half":
        deviates *= x > np.median(x)
    elif kind == "uneven":
        deviates *= 2 * (x - x.min()) / np.ptp(x)
    moves = step * deviates
    if kind == "outliers":
        far = rng.choice(count, int(PART * count), replace=False)
        moves[far] = FAR * length * rng.choice([-1, 1], len(far))
    return mesh.moved(vertices + moves[:, None] * mesh.normals)


def _correlated(mesh, x):
    edges = np.concatenate([mesh.faces[:, [0, 1]], mesh.faces[:, [1, 2]], mesh.faces[:, [2, 0]]])
    for _ in range(SWEEPS):
        total, number = np.array(x), np.ones(len(x))
        for a, b in (edges.T, edges.T[::-1]):
            np.add.at(total, a, x[b])
            np.add.at(number, a, 1)
        x = total / number
    return x / x.std()
