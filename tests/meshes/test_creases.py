"""Creases: found where there are some and nowhere else; meshes cut along them."""

import numpy as np
import pytest
import pyvista
from sharp import block, can, noisy, rounded
from test_ball_regression import voxel_sphere

import curvlib
from curvlib.meshes.creases import creases
from curvlib.meshes.cutting import cut, larger_sides
from curvlib.meshes.jittered import jittered


def on_block(points):
    """On an edge of a cube of side 2."""
    return (np.abs(np.abs(points) - 1) < 1e-9).sum(1) > 1


def edges_on(mesh, on):
    """The edges of a mesh that lie on a line: whose ends and middle do, to within its curvature."""
    sides = np.sort(np.vstack([mesh.faces[:, [k, k - 1]] for k in range(3)]), axis=1)
    sides = np.unique(sides, axis=0)
    ends = mesh.vertices[sides]
    return sides[on(ends[:, 0]) & on(ends[:, 1]) & on(ends.mean(1))]


@pytest.mark.parametrize("n", [6, 20])
def test_all_edges_of_a_block(n):
    mesh = block(n)
    found = creases(mesh)
    assert len(found) == 12 * n
    np.testing.assert_array_equal(found, edges_on(mesh, on_block))


@pytest.mark.parametrize("around", [24, 60])
def test_all_of_the_rims_of_a_cylinder(around):
    """Coarse ones, too: 15 degrees from row to row of the wall."""
    mesh = can(around, around // 2)

    def rims(points):
        return (np.abs(points[:, 2]) == 1) & (np.linalg.norm(points[:, :2], axis=1) > 0.99)

    np.testing.assert_array_equal(creases(mesh), edges_on(mesh, rims))


def test_where_faces_meet_at_a_small_angle():
    """A roof of 12 degrees over a jittered square, along a row of the grid."""
    n, rng = 21, np.random.default_rng(1)
    x, y = np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n), indexing="ij")
    inner = (np.abs(x) < 1) & (np.abs(y) < 1) & (x != 0)
    x = x + rng.uniform(-0.03, 0.03, x.shape) * inner
    y = y + rng.uniform(-0.03, 0.03, x.shape) * inner
    i, j = np.divmod(np.arange((n - 1) ** 2), n - 1)
    a = i * n + j
    faces = np.vstack(
        (np.column_stack((a, a + n, a + n + 1)), np.column_stack((a, a + n + 1, a + 1)))
    )
    z = -np.tan(np.radians(6)) * np.abs(x)
    mesh = curvlib.Mesh(np.column_stack((x.ravel(), y.ravel(), z.ravel())), faces)
    np.testing.assert_array_equal(creases(mesh), edges_on(mesh, lambda p: p[:, 0] == 0))


def test_in_noise():
    mesh = block(20)
    moves = np.random.default_rng(3).standard_normal(mesh.vertices.shape)
    rough = curvlib.Mesh(mesh.vertices + 0.01 * mesh.mean_edge * moves, mesh.faces)
    np.testing.assert_array_equal(creases(rough), edges_on(mesh, on_block))


@pytest.mark.parametrize("n", [6, 8, 16, 32])
@pytest.mark.parametrize("name", ["sphere", "ellipsoid", "revolution", "teapot_body", "cylinder"])
def test_none_on_smooth_surfaces(name, n):
    for diagonal in ("same", "jittered"):
        assert not len(creases(curvlib.tessellate(curvlib.surface(name), n, diagonal)))


@pytest.mark.parametrize("n", [12, 30, 90])
@pytest.mark.parametrize("surface", ["torus", "ellipsoid", "patch"])
def test_none_on_irregular_meshes(surface, n):
    assert not len(creases(jittered(surface, n, 7)))


@pytest.mark.parametrize("sigma", [1e-6, 1e-4, 1e-3, 0.01, 0.05, 0.2])
@pytest.mark.parametrize("surface", ["torus", "ellipsoid", "patch"])
def test_none_in_noise(surface, sigma):
    assert not len(creases(noisy(jittered(surface, 50, 8), sigma)))


@pytest.mark.parametrize(("n", "radius"), [(24, 0.25), (24, 0.5), (48, 0.25)])
def test_none_on_rounded_edges(n, radius):
    assert not len(creases(rounded(n, radius)))


@pytest.mark.parametrize("r", [5, 10, 20])
def test_none_on_staircases(r):
    assert not len(creases(voxel_sphere(r)))


@pytest.mark.parametrize("part", [0.5, 0.8, 0.95])
@pytest.mark.parametrize("surface", ["torus", "ellipsoid", "patch"])
def test_none_on_decimated_meshes(surface, part):
    mesh = jittered(surface, 80, 1)
    fewer = pyvista.PolyData.from_regular_faces(mesh.vertices, mesh.faces).decimate(part)
    assert not len(creases(curvlib.Mesh(fewer.points, fewer.regular_faces)))


def test_none_at_displaced_vertices():
    mesh, rng = jittered("torus", 50, 2), np.random.default_rng(2)
    vertices, far = mesh.vertices.copy(), rng.choice(2500, 12, replace=False)
    vertices[far] += 5 * mesh.mean_edge * mesh.normals[far]
    assert not len(creases(curvlib.Mesh(vertices, mesh.faces)))


@pytest.mark.parametrize("scale", [1e-60, 1e60])
def test_edges_do_not_depend_on_unit_place_or_threads(scale):
    mesh = block(8)
    expected = creases(mesh)
    turn = np.linalg.qr(np.random.default_rng(4).standard_normal((3, 3)))[0]
    moved = curvlib.Mesh(mesh.vertices @ (turn * np.linalg.det(turn)) + 5, mesh.faces)
    scaled = curvlib.Mesh(mesh.vertices * scale, mesh.faces)
    for other, threads in ((moved, 1), (scaled, 1), (mesh, 3)):
        np.testing.assert_array_equal(creases(other, threads), expected)


def test_empty_and_broken_meshes_have_none():
    none = curvlib.Mesh(np.empty((0, 3)), np.empty((0, 3), int))
    flat = curvlib.Mesh([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    for mesh in (none, flat):
        assert creases(mesh).shape == (0, 2)


def test_a_cut_parts_the_faces_of_a_block():
    """Six pieces with the areas of faces; at a corner three vertices, at an edge two."""
    n, sizes = 6, (1, 2, 3)
    mesh = block(n, sizes=sizes)
    parted, index = cut(mesh, creases(mesh))
    np.testing.assert_array_equal(index[parted.faces], mesh.faces)
    np.testing.assert_array_equal(parted.vertices, mesh.vertices[index])
    uses = np.bincount(index)
    assert sorted(np.unique(uses, return_counts=True)[1]) == [8, 12 * (n - 1), 6 * (n - 1) ** 2]
    report = curvlib.check(parted)
    assert (report.components, report.boundaries) == (6, 6)
    taken = parted.vertices[larger_sides(parted, index)]
    np.testing.assert_array_equal(taken, mesh.vertices)
    # Of a corner, and of edges that it has, the face of 2 by 3.
    least = np.abs(parted.vertices[parted.faces[:, 0], 0] + parted.vertices[parted.faces[:, 1], 0])
    of_largest = np.unique(parted.faces[least > 0.999])
    wide = np.flatnonzero(np.abs(mesh.vertices[:, 0]) == 0.5)
    assert np.isin(larger_sides(parted, index)[wide], of_largest).all()


def test_a_cut_that_ends_leaves_its_tips_whole():
    mesh = jittered("torus", 20, 1)
    path, at = [5], mesh.find_adjacency()
    for _ in range(4):
        row = at.neighbours[at.offsets[path[-1]] : at.offsets[path[-1] + 1]]
        path.append(
            int(
                row[mesh.vertices[row, 2].argmax()]
                if len(path) < 2
                else next(
                    v
                    for v in row.tolist()
                    if v not in path
                    and not {*path[:-1]}
                    & {*at.neighbours[at.offsets[v] : at.offsets[v + 1]].tolist()}
                )
            )
        )
    edges = np.column_stack((path[:-1], path[1:]))
    parted, index = cut(mesh, edges)
    assert sorted(index[len(mesh.vertices) :]) == sorted(path[1:-1])
    assert curvlib.check(parted).boundaries == 1
    assert parted.mean_edge == mesh.mean_edge
