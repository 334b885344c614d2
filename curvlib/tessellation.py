"""From a NURBS surface to a triangle mesh: the uniform grid, its seams, poles and diagonals."""

from numbers import Integral

import numpy as np

from .errors import InputError, check_name
from .mesh import Mesh
from .nurbs import Surface


def check_resolution(n, where: str = "") -> None:
    """Raise InputError unless n is an integer of at least 3."""
    if not isinstance(n, Integral) or isinstance(n, bool) or n < 3:
        place = f"{where}: " if where else ""
        raise InputError(f"{place}resolution {n!r} is not an integer of at least 3")


def tessellate(surface: Surface, n: int, diagonal: str = "same", seed: int = 0) -> Mesh:
    """A mesh of n x n cells uniform in (u, v), cut in two, with exact values at its vertices.

    Seams are welded, a pole is one vertex and its cells are single triangles: 2 n^2 triangles,
    less n per pole. Faces turn like S_u x S_v. A vertex on a seam or pole has the lowest of its
    parameters as `uv`.

    `diagonal`: "same" joins (u_i, v_j) to (u_i+1, v_j+1) in every cell, "alternate" changes
    from cell to cell like a chessboard, "shortest" takes the shorter one in space (equal ones
    as "same"), "random" draws with `seed`.

    Raises InputError for a resolution below 3 or not an integer, and for an unknown diagonal.
    """
    check_resolution(n)
    check_name("diagonal", diagonal, DIAGONALS)
    steps = np.arange(n + 1)
    # (high - low) k / n is correctly rounded, so that knots at grid rows are met exactly.
    u, v = (low + (high - low) * steps / n for low, high in surface.domain)
    index = steps[:, None] * (n + 1) + steps
    for axis, line in enumerate((index, index.T)):
        if surface.closed[axis]:
            line[-1] = line[0]
        for end in (0, -1):
            if surface.has_pole(axis, end):
                line[end] = line[end].min()
    kept, index = np.unique(index, return_inverse=True)
    index = index.reshape(n + 1, n + 1)
    uv = np.column_stack((u[kept // (n + 1)], v[kept % (n + 1)]))
    vertices = surface.point(*uv.T)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    other = DIAGONALS[diagonal](vertices, a, b, c, d, seed)[..., None]
    lower = np.where(other, np.stack((a, b, d), -1), np.stack((a, b, c), -1))
    upper = np.where(other, np.stack((b, c, d), -1), np.stack((a, c, d), -1))
    faces = np.stack((lower, upper), axis=2).reshape(-1, 3)
    collapsed = (faces == np.roll(faces, 1, axis=1)).any(1)
    exact = surface.curvature(*uv.T)
    fields = exact._asdict()
    return Mesh(vertices, faces[~collapsed], uv=uv, normals=fields.pop("normal"), **fields)


def _same(vertices, a, b, c, d, seed):
    return np.zeros(a.shape, dtype=bool)


def _alternate(vertices, a, b, c, d, seed):
    i, j = np.indices(a.shape)
    return (i + j) % 2 == 1


def _random(vertices, a, b, c, d, seed):
    return np.random.default_rng(seed).random(a.shape) < 0.5


def _shortest(vertices, a, b, c, d, seed):
    ac, bd = (((vertices[p] - vertices[q]) ** 2).sum(-1) for p, q in ((a, c), (b, d)))
    return bd < ac * (1 - 1e-9)


# Each tells for the cells with corners a, b, c, d whether they are cut along b-d, not a-c.
DIAGONALS = {"same": _same, "alternate": _alternate, "random": _random, "shortest": _shortest}
