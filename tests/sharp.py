"""Meshes of solids with sharp or rounded edges, for tests."""

import itertools

import numpy as np
from scipy.spatial import Delaunay

import curvlib


def block(n, seed=0, sizes=(2, 2, 2)):
    """A block about the origin with n cells along each edge; points within its faces are moved."""
    rng, grid, faces, index = np.random.default_rng(seed), np.linspace(-1, 1, n + 1), [], {}
    for axis, sign in itertools.product(range(3), (-1, 1)):
        for i, j in itertools.product(range(n), repeat=2):
            cell = []
            for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                point = np.zeros(3)
                point[axis] = sign
                point[[(axis + 1) % 3, (axis + 2) % 3]] = grid[i + a], grid[j + b]
                cell.append(index.setdefault(tuple(point), len(index)))
            a, b, c, d = cell
            cut = [(a, b, c), (a, c, d)] if rng.random() < 0.5 else [(a, b, d), (b, c, d)]
            faces += cut if sign > 0 else [triangle[::-1] for triangle in cut]
    points = np.array(list(index))
    inner = (np.abs(points) < 1) & ((np.abs(points) == 1).sum(1) == 1)[:, None]
    points += rng.uniform(-0.3, 0.3, points.shape) * 2 / n * inner
    return curvlib.Mesh(points * np.array(sizes) / 2, np.array(faces))


def rounded(n, radius):
    """A cube of side 2 with edges rounded by arcs, whose angles the cells divide evenly."""
    sharp = block(n)
    inner = np.abs(sharp.vertices) < 1
    grid = np.round((sharp.vertices + 1) * n / 2) * 2 / n - 1
    points = np.where(inner, grid, sharp.vertices)
    core = np.clip(points, radius - 1, 1 - radius)
    out = np.tan(np.pi / 4 * (points - core) / radius)
    out /= np.linalg.norm(out, axis=1)[:, None]
    return curvlib.Mesh(core + radius * out, sharp.faces)


def can(around, along, seed=0):
    """A cylinder of radius 1 and height 2 with caps; points off its rims are moved."""
    rng, step = np.random.default_rng(seed), 2 * np.pi / around
    i, j = np.divmod(np.arange(around * (along + 1)), along + 1)
    inner = (j > 0) & (j < along)
    turn, z = (
        x + rng.uniform(-0.3, 0.3, x.shape) * h * inner
        for x, h in ((i * step, step), (2 * j / along - 1, 2 / along))
    )
    points = [np.column_stack((np.cos(turn), np.sin(turn), z))]
    i, j = np.divmod(np.arange(around * along), along)
    a, b = i * (along + 1) + j, (i + 1) % around * (along + 1) + j
    faces = [np.column_stack((a, b, b + 1)), np.column_stack((a, b + 1, a + 1))]
    count = len(points[0])
    for end, sign in ((0, -1), (along, 1)):
        rim = np.arange(around) * (along + 1) + end
        x, y = np.meshgrid(np.arange(-1, 1, step), np.arange(-1, 1, 0.87 * step))
        x = x + step / 2 * (np.arange(len(x)) % 2)[:, None]
        disk = np.column_stack((x.ravel(), y.ravel()))
        disk = disk[np.linalg.norm(disk, axis=1) < 1 - 0.6 * step]
        disk += rng.uniform(-0.2, 0.2, disk.shape) * step
        number = np.concatenate((rim, count + np.arange(len(disk))))
        flat = np.vstack((points[0][rim, :2], disk))
        triangles = Delaunay(flat).simplices
        p, q = (flat[triangles[:, k]] - flat[triangles[:, 0]] for k in (1, 2))
        turned = sign * (p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]) < 0
        triangles[turned] = triangles[turned, ::-1]
        faces.append(number[triangles])
        points.append(np.column_stack((disk, np.full(len(disk), float(sign)))))
        count += len(disk)
    return curvlib.Mesh(np.vstack(points), np.vstack(faces))


def noisy(mesh, sigma, seed=5):
    """The mesh with normal noise of sigma mean edges along the normals that it has."""
    moves = np.random.default_rng(seed).standard_normal((len(mesh.vertices), 1))
    return curvlib.Mesh(mesh.vertices + sigma * mesh.mean_edge * moves * mesh.normals, mesh.faces)
