"""Joining points and orienting triangles."""

import numpy as np
import pytest
import pyvista

import curvlib
from curvlib.meshes.mend import orient, weld
from curvlib.meshes.torus import torus


def soup(vertices, faces):
    """Each triangle with corners of its own, the whole in another order."""
    return vertices[faces].reshape(-1, 3), np.arange(faces.size).reshape(-1, 3)


def volume(mesh):
    a, b, c = mesh.vertices[mesh.faces].transpose(1, 0, 2)
    return (a * np.cross(b, c)).sum() / 6


def test_a_soup_becomes_the_mesh():
    vertices, faces = torus(12, "irregular")
    points, corners = soup(vertices, faces)
    normals = np.random.default_rng(0).normal(size=points.shape)
    mesh, index = weld(curvlib.Mesh(points, corners, normals=normals))
    assert len(np.unique(index)) == len(vertices)
    np.testing.assert_array_equal(points[index], points)
    expected = curvlib.estimate((vertices, faces), "taubin").K[faces.reshape(-1)]
    np.testing.assert_allclose(curvlib.estimate(mesh, "taubin").K[index], expected, rtol=1e-12)
    unit = normals / np.linalg.norm(normals, axis=1)[:, None]
    sums = np.array([unit[index == i].sum(0) for i in np.unique(index)])
    means = sums / np.linalg.norm(sums, axis=1)[:, None]
    np.testing.assert_allclose(mesh.normals[np.unique(index)], means, atol=1e-12)


def test_closed_sheets_that_touch_stay_apart():
    vertices, faces = torus(8, "regular")
    both = np.vstack((vertices, vertices)), np.vstack((faces, faces + len(vertices)))
    _, index = weld(curvlib.Mesh(*both))
    np.testing.assert_array_equal(index, np.arange(2 * len(vertices)))


def test_what_would_form_no_disk_stays_apart():
    """Two open fans with one tip, and a page more at the spine of a book."""
    mesh = curvlib.tessellate(curvlib.surface("cone"), 6)
    twice = np.vstack((mesh.vertices, mesh.vertices))
    faces = np.vstack((mesh.faces, mesh.faces + len(mesh.vertices)))
    _, index = weld(curvlib.Mesh(twice, faces))
    np.testing.assert_array_equal(index, np.arange(len(twice)))
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    turned = square @ [[0, 0, 1], [0, 1, 0], [-1, 0, 0]]
    third = square @ [[-1, 0, 0], [0, 1, 0], [0, 0, 1]]
    pages = curvlib.Mesh(
        np.vstack((square, turned, third)),
        np.vstack([np.array([[0, 1, 2], [0, 2, 3]]) + 4 * k for k in range(3)]),
    )
    _, index = weld(pages)
    np.testing.assert_array_equal(index, np.arange(12))


def test_joining_within_a_distance():
    vertices, faces = torus(12, "irregular")
    points, corners = soup(vertices, faces)
    moved = points + np.random.default_rng(1).uniform(-1e-7, 1e-7, points.shape)
    _, index = weld(curvlib.Mesh(moved, corners))
    assert len(np.unique(index)) == len(points)
    mesh, index = weld(curvlib.Mesh(moved, corners), 1e-6)
    assert len(np.unique(index)) == len(vertices)
    assert mesh.closed[np.unique(index)].all()
    for distance in (-1, np.inf, np.nan):
        with pytest.raises(curvlib.InputError, match="is not a length"):
            weld(mesh, distance)


@pytest.mark.parametrize("seed", range(5))
def test_triangles_turned_at_random_are_turned_back(seed):
    """Two closed components, one within the other's bounds, far from the origin; an open one."""
    rng = np.random.default_rng(seed)
    vertices, faces = torus(10, "irregular")
    ball = pyvista.Icosphere(radius=0.2, nsub=1)
    patch = curvlib.tessellate(curvlib.surface("teapot_spout"), 5)
    points = np.vstack((vertices, ball.points + np.array((2, 0, 0)), patch.vertices)) + 1e6
    sizes = np.cumsum([0, len(vertices), len(ball.points)])
    right = np.vstack((faces, ball.regular_faces + sizes[1], patch.faces + sizes[2]))
    turned = rng.random(len(right)) < 0.4
    given = np.where(turned[:, None], right[:, [0, 2, 1]], right)
    oriented, again = orient(curvlib.Mesh(points, given))
    kept = len(faces) + ball.n_cells
    np.testing.assert_array_equal(again[:kept], turned[:kept])
    # The open component agrees, whichever way.
    assert len(set(again[kept:] ^ turned[kept:])) == 1
    assert curvlib.estimate(oriented, "taubin").undefined == {"boundary": patch.boundary.sum()}


def test_outward():
    vertices, faces = torus(8, "regular")
    inward = curvlib.Mesh(vertices, faces[:, ::-1])
    assert volume(inward) < 0
    oriented, turned = orient(inward)
    assert volume(oriented) > 0
    assert turned.all()
    assert not orient(oriented)[1].any()


def test_what_cannot_be_oriented_stays():
    n = 12
    angle = np.linspace(0, 2 * np.pi, n, endpoint=False)
    tilt = np.array([[-0.3], [0.3]]) * np.ones(n)
    points = np.stack(
        (
            (1 + tilt * np.cos(angle / 2)) * np.cos(angle),
            (1 + tilt * np.cos(angle / 2)) * np.sin(angle),
            tilt * np.sin(angle / 2),
        ),
        -1,
    ).reshape(-1, 3)
    k = np.arange(n)
    low, high = k, k + n
    low1, high1 = np.roll(low, -1), np.roll(high, -1)
    low1[-1], high1[-1] = n, 0
    strip = np.vstack((np.column_stack((low, low1, high)), np.column_stack((low1, high1, high))))
    assert not orient(curvlib.Mesh(points, strip))[1].any()
    none = curvlib.Mesh(np.zeros((3, 3)), np.zeros((0, 3), int))
    assert orient(none)[1].shape == (0,)
    assert weld(none)[1].tolist() == [0, 1, 2]


@pytest.mark.parametrize("fault", ["turned", "fin", "there twice", "left out"])
def test_one_fault_in_a_soup_is_felt_at_its_corners_alone(fault):
    sphere = curvlib.tessellate(curvlib.surface("sphere"), 12)
    faces = [list(face) for face in sphere.faces]
    points = np.vstack((sphere.vertices, [[0, 0, 3.0]]))
    corners = faces[100]
    if fault == "turned":
        faces[100] = corners[::-1]
    elif fault == "fin":
        faces.append([corners[0], corners[1], len(points) - 1])
    elif fault == "there twice":
        faces.append(corners)
    else:
        del faces[100]
    faces = np.array(faces)
    soup = points[faces].reshape(-1, 3)
    welded, index = weld(curvlib.Mesh(soup, np.arange(faces.size).reshape(-1, 3)))
    away = ~np.isin(faces, [*corners, len(points) - 1]).reshape(-1)
    assert welded.closed[index[away]].all()
    assert len(np.unique(index[away])) == len(sphere.vertices) - 3
