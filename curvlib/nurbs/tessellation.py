"""From a NURBS surface to a triangle mesh: the uniform grid, its seams, poles and diagonals."""

import itertools
from numbers import Integral

import numpy as np

from curvlib.errors import InputError, check_name
from curvlib.meshes.mesh import Mesh

from .surface import Surface

MOST = 18918  # cells along u: the 6 n^2 corners of faces are counted in 31 bits
JITTER = 0.3  # of a cell; below 0.5 the points of a row keep their order


def check_resolution(n, where: str = "") -> None:
    """Raise InputError unless n is an integer from 3 to MOST."""
    place = f"{where}: " if where else ""
    if not isinstance(n, Integral) or isinstance(n, bool) or n < 3:
        raise InputError(f"{place}resolution {n!r} is not an integer of at least 3")
    if n > MOST:
        raise InputError(f"{place}resolution {n!r} is more than {MOST}")


def check_cut(key, where: str = "") -> None:
    """Raise InputError unless `key` is a diagonal, or a seeded one with its seed: `random-3`."""
    diagonal, dash, seed = str(key).partition("-")
    check_name("diagonal", diagonal, DIAGONALS, where)
    if dash and not (seed.isascii() and seed.isdecimal() and diagonal in SEEDED):
        place = f"{where}: " if where else ""
        raise InputError(f"{place}{key!r}: a seed is a number, after {' or '.join(SEEDED)} alone")


def tessellate(surface: Surface, n: int, diagonal: str = "same", seed: int = 0) -> Mesh:
    """A triangle mesh of a surface, with exact values at its vertices.

    The grid has n x n cells uniform in (u, v), each cut in two. Seams are welded, a pole is one
    vertex and its cells are single triangles: 2 n^2 triangles, less n per pole. Faces turn like
    S_u x S_v.

    Parameters
    ----------
    surface : Surface
        From `curvlib.surface`, or made from a geomdl surface.
    n : int
        Cells along u and along v, at least 3.
    diagonal : str, optional
        "same" joins (u_i, v_j) to (u_i+1, v_j+1) in every cell, "alternate" changes from cell to
        cell like a chessboard, "shortest" takes the shorter diagonal in space (as "same" if they
        are equal), "random" draws one; "jittered" moves every grid point by up to JITTER cells (at
        a boundary along it) and triangulates by Delaunay in the parameter domain. "random-3" is
        "random" with seed 3.
    seed : int, optional
        Seed of "random" and "jittered", if `diagonal` names none.

    Returns
    -------
    Mesh
        `vertices` in the unit of the surface, `faces`, `uv` (on a seam or pole the lowest of
        its parameters), and the fields of `Curvature` (its `normal` is `normals`), pointwise, NaN
        where the surface is not C^2; `pole` (V,) bool.

    Raises
    ------
    InputError
        A resolution below 3 or not an integer, an unknown diagonal, or a bad seed.

    Examples
    --------
    >>> import curvlib
    >>> mesh = curvlib.tessellate(curvlib.surface("sphere"), 8)
    >>> mesh
    <Mesh of 58 vertices, 112 faces>
    >>> mesh.K.round(12).min(), mesh.H.round(12).max()
    (np.float64(1.0), np.float64(1.0))
    """
    if not isinstance(surface, Surface):
        raise InputError(
            f"a curvlib.Surface is needed, not {type(surface).__name__}: curvlib.surface(name) or "
            "curvlib.Surface(model) makes one"
        )
    check_resolution(n)
    check_cut(diagonal)
    if not isinstance(seed, Integral) or seed < 0:
        raise InputError(f"seed {seed!r} is not an integer of at least 0")
    diagonal, _, number = diagonal.partition("-")
    grid = _Grid(surface, n)
    at, faces = DIAGONALS[diagonal](grid, np.random.default_rng(int(number or seed)))
    collapsed = (faces == np.roll(faces, 1, axis=1)).any(1)
    uv = grid.parameters(at)
    exact = surface.curvature(*uv.T)._asdict()
    vertices, normals = exact.pop("point"), exact.pop("normal")
    return Mesh(vertices, faces[~collapsed], uv=uv, normals=normals, pole=grid.pole, **exact)


class _Grid:
    """The uniform grid with seams and poles merged.

    `index` (n + 1, n + 1): the vertex of each grid point; `at` (2, V): places of the vertices, in
    cells; `pole` (V,) bool.
    """

    def __init__(self, surface, n):
        self.surface, self.n = surface, n
        steps = np.arange(n + 1)
        index = steps[:, None] * (n + 1) + steps
        poles = []
        for axis, line in enumerate((index, index.T)):
            if surface.closed[axis]:
                line[-1] = line[0]
            for end in (0, -1):
                if surface.has_pole(axis, end):
                    line[end] = line[end].min()
                    poles.append(line[end, 0])
        kept, index = np.unique(index, return_inverse=True)
        self.pole = np.isin(kept, poles)
        self.index = index.reshape(n + 1, n + 1)
        self.at = np.array([kept // (n + 1), kept % (n + 1)])

    def parameters(self, at):
        """(u, v), (V, 2), at places in cells; rounded to a knot within four rounding errors."""
        uv = []
        for k, breaks in zip(at, self.surface.breaks):
            low, high = breaks[0], breaks[-1]
            t = low + (high - low) * k / self.n
            near = 4 * np.spacing(max(abs(low), abs(high)))
            for line in breaks:
                t[np.abs(t - line) <= near] = line
            uv.append(t)
        return np.stack(uv, axis=1)

    def corners(self):
        """The vertices a, b, c, d around every cell, each (n, n)."""
        i = self.index
        return i[:-1, :-1], i[1:, :-1], i[1:, 1:], i[:-1, 1:]

    def cut(self, other):
        """Faces (2 n^2, 3): cells cut along a-c, or along b-d where `other` (n, n) is true."""
        a, b, c, d = self.corners()
        other = np.broadcast_to(other, a.shape)[..., None]
        lower = np.where(other, np.stack((a, b, d), -1), np.stack((a, b, c), -1))
        upper = np.where(other, np.stack((b, c, d), -1), np.stack((a, c, d), -1))
        return np.stack((lower, upper), axis=2).reshape(-1, 3)


def _same(grid, rng):
    return grid.at, grid.cut(False)


def _alternate(grid, rng):
    i, j = np.indices((grid.n, grid.n))
    return grid.at, grid.cut((i + j) % 2 == 1)


def _shortest(grid, rng):
    points = grid.surface.point(*grid.parameters(grid.at).T)
    a, b, c, d = grid.corners()
    ac, bd = (((points[p] - points[q]) ** 2).sum(-1) for p, q in ((a, c), (b, d)))
    return grid.at, grid.cut(bd < ac * (1 - 1e-9))


def _random(grid, rng):
    return grid.at, grid.cut(rng.random((grid.n, grid.n)) < 0.5)


def _jittered(grid, rng):
    """Jittered points, triangulated by Delaunay with copies beyond the seams."""
    from scipy.spatial import Delaunay

    n, surface = grid.n, grid.surface
    nodes = np.array(
        list(itertools.product(*(range(n if closed else n + 1) for closed in surface.closed)))
    )
    at = nodes + rng.uniform(-JITTER, JITTER, nodes.shape)
    for axis in (0, 1):
        if surface.closed[axis]:
            continue
        for end, line in ((0, 0), (-1, n)):
            on_edge = nodes[:, axis] == line
            at[on_edge, axis] = line
            if surface.has_pole(axis, end):
                at[on_edge] = nodes[on_edge]
    vertex = grid.index[tuple(nodes.T)]
    moved = np.empty(grid.at.shape)
    # In reverse order: the first of the nodes that share a pole is written last and kept.
    moved[:, vertex[::-1]] = at[::-1].T
    for axis in np.flatnonzero(surface.closed):
        moved[axis] %= n
    shifts = itertools.product(*((0, -n, n) if closed else (0,) for closed in surface.closed))
    copies = np.concatenate([at + shift for shift in shifts])
    triangles = Delaunay(copies).simplices
    (ax, ay), (bx, by), (cx, cy) = copies[triangles].transpose(1, 2, 0)
    clockwise = (bx - ax) * (cy - ay) < (by - ay) * (cx - ax)
    triangles[clockwise] = triangles[clockwise][:, ::-1]
    # Keep of each triangle's copies the one whose lowest node is no copy.
    node = triangles % len(at)
    first = triangles[np.arange(len(node)), node.argmin(1)]
    return moved, vertex[node[first < len(at)]]


# Each maps a grid to places of the vertices (2, V), in cells, and faces (F, 3).
DIAGONALS = {
    "same": _same,
    "alternate": _alternate,
    "shortest": _shortest,
    "random": _random,
    "jittered": _jittered,
}
SEEDED = ("random", "jittered")
