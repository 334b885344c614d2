"""Voxels and lattice points, turned and rounded to float32: right angles and equal distances, where
the sign of a rounding error decides whether a neighbour counts, or points lie on two lines."""

import functools

import numpy as np
import pytest
from scipy.spatial import ConvexHull

import curvlib

# Fits to residuals choose among quadrics that fit voxels equally well; fits of degree 6, and what
# chooses them, among neighbourhoods. Others have the same values whichever way they are turned.
CHOOSING = {"robust", "compact_hermite", "adaptive_fit"}

CROSS = (
    [[0, 0, 0], [-3.4, 0, 0], [0, 0, 4.5], [1.5, -1.5, 0], [0, 0, -4.5], [-1, -6, 0]],
    [[0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4], [5, 1, 2], [5, 2, 3], [5, 3, 4], [5, 4, 1]],
)


def voxels(rng, n, part, size=1):
    """The boundary of a part of n^3 voxels, each square cut along a random diagonal."""
    solid = np.kron(rng.random((n, n, n)) < part, np.ones((size, size, size), bool))
    solid = np.pad(solid, 1).astype(int)
    squares = []
    for axis in range(3):
        own, second, third = np.roll(np.eye(3, dtype=int), -axis, axis=0)
        for sign in (1, -1):
            low = np.argwhere(np.diff(solid, axis=axis) == -sign) + own
            square = np.stack((low, low + second, low + second + third, low + third), 1)
            squares.append(square[:, ::sign])
    corners = np.concatenate(squares)
    vertices, index = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    index = index.reshape(-1, 4)
    turned = rng.random(len(index)) < 0.5
    index[turned] = np.roll(index[turned], 1, axis=1)
    return vertices.astype(float), np.vstack((index[:, [0, 1, 2]], index[:, [0, 2, 3]]))


def hull(rng, count):
    """The convex hull of lattice points."""
    points = np.unique(rng.integers(0, 4, (count, 3)), axis=0).astype(float)
    faces = ConvexHull(points, qhull_options="Qt").simplices
    a, b, c = points[faces].transpose(1, 0, 2)
    inward = (np.cross(b - a, c - a) * (a - points.mean(0))).sum(1) < 0
    return points, np.where(inward[:, None], faces[:, ::-1], faces)


@functools.cache
def shapes():
    rng = np.random.default_rng(2)
    made = [voxels(rng, 3, 0.4) for _ in range(8)]
    made += [voxels(rng, 2, 0.5, 2), voxels(rng, 2, 0.5, 3), tuple(map(np.array, CROSS))]
    return made + [hull(rng, 12) for _ in range(12)]


@pytest.mark.parametrize("name", curvlib.estimators())
@pytest.mark.filterwarnings("ignore::curvlib.MeshWarning")
def test_no_value_is_that_of_rounding(name):
    """Curvature radii are no shorter than a fiftieth of an edge, and do not change much as the mesh
    is turned."""
    rng = np.random.default_rng(0)
    for vertices, faces in shapes():
        sides = vertices[faces] - vertices[np.roll(faces, 1, axis=1)]
        edge = np.linalg.norm(sides, axis=2).mean()
        found = []
        for _ in range(3):
            turn, _ = np.linalg.qr(rng.normal(size=(3, 3)))
            turn *= np.sign(np.linalg.det(turn))
            placed = (vertices @ turn.T + rng.uniform(-9, 9, 3)).astype(np.float32)
            found.append(curvlib.estimate((placed, faces), name))
        H, K = np.array([r.H * edge for r in found]), np.array([r.K * edge**2 for r in found])
        assert np.nanmax(np.abs(H), initial=0) < 50
        assert np.nanmax(np.abs(K), initial=0) < 50**2
        if name not in CHOOSING:
            np.testing.assert_array_equal(np.isnan(K), np.isnan(K[:1]).repeat(3, axis=0))
            assert np.nanmax(np.ptp(H, axis=0), initial=0) < 0.2
