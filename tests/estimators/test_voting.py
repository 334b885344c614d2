"""Tensor voting: against a plain implementation, closed forms, its order, where it is undefined."""

from typing import Literal

import numpy as np
import pytest
import pyvista
import voting
from scipy.spatial import ConvexHull
from test_fits import graph, wavy

import curvlib
from curvlib.estimators import tensor_voting
from curvlib.kit.compiled import kernel
from curvlib.kit.options import Geodesic
from curvlib.meshes.torus import torus


@pytest.mark.parametrize("per", ["vertex", "face"])
@pytest.mark.parametrize("weights", ["area", "none"])
@pytest.mark.parametrize("directions", ["uniform", "fitted"])
def test_against_a_plain_implementation(per, weights, directions):
    """On an irregular mesh, whose boundary votes as well."""
    mesh = graph(15, wavy, seed=3)
    options = {"weights": weights, "directions": directions}
    found = curvlib.estimate(mesh, "tensor_voting", per=per, radius=0.6, **options)
    k1, k2, d1 = voting.estimate(mesh.vertices, mesh.faces, per, 0.6, **options)
    # Arccosines of the plain implementation are off by up to 1e-8.
    np.testing.assert_allclose(found.k1, k1, atol=1e-7)
    np.testing.assert_allclose(found.k2, k2, atol=1e-7)
    np.testing.assert_allclose(np.abs((found.d1 * d1).sum(1)), 1, atol=1e-9)


def sphere(side, seed=1):
    """Triangles between points of a sphere of radius 2, and its normals."""
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(side, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    faces = ConvexHull(points).simplices
    a, b, c = points[faces].transpose(1, 0, 2)
    turned = (np.cross(b - a, c - a) * a).sum(1) < 0
    faces[turned] = faces[turned, ::-1]
    return curvlib.Mesh(2 * points, faces, normals=points)


@kernel
def normals(disk):
    """Those that the mesh has, and areas."""
    return *disk.exact_normal, disk.area


@kernel
def with_normals(
    disk,
    normals,
    radius: Geodesic = "3 edges",
    weights: Literal["area", "none"] = "area",
    directions: Literal["uniform", "fitted"] = "uniform",
):
    """The second pass alone."""
    return tensor_voting.estimate(disk, normals, radius, weights, directions)


@kernel
def carried(disk, normals, radius: Geodesic = "3 edges"):
    """The square of the distance between the voted normal and that of the mesh; the area."""
    n = tensor_voting.voted(disk, normals, radius)
    off = 0.0
    for c in range(3):
        off += (n[c] - disk.exact_normal[c]) ** 2
    return off, n[3] - disk.area


def test_votes_on_a_sphere_are_exact():
    """Normals are carried along circles, and all circles through two points of a sphere that have
    its normals have its curvature."""
    mesh = sphere(300)
    off = curvlib.estimate(mesh, carried)
    assert off.K.max() < 1e-24
    assert (off.H == 0).all()
    for weights in ("area", "none"):
        found = curvlib.estimate(mesh, with_normals, weights=weights, directions="fitted")
        np.testing.assert_allclose(found.k1, 0.5, rtol=1e-12)
        np.testing.assert_allclose(found.k2, 0.5, rtol=1e-12)
        # The mean of the votes is H. Their weights in different directions are not equal.
        found = curvlib.estimate(mesh, with_normals, weights=weights)
        np.testing.assert_allclose(found.H, 0.5, rtol=1e-12)
        assert (found.K < 0.25).all()
        assert np.median(found.K) > 0.2


def test_cylinder_and_plane():
    """k2 = 0 along a cylinder's lines; votes from one side alone tilt the normals at its boundary.
    A plane has no curvature."""
    i, j = np.divmod(np.arange(40 * 60), 60)
    angle, z = 2 * np.pi / 60 * (j + 0.5 * i), 0.09 * i
    vertices = np.column_stack((np.cos(angle), np.sin(angle), z))
    at = np.arange(39 * 60).reshape(39, 60)
    a, b, c, d = at, np.roll(at, -1, 1), np.roll(at, -1, 1) + 60, at + 60
    faces = np.stack((a, b, d, b, c, d), -1).reshape(-1, 3)
    found = curvlib.estimate((vertices, faces), "tensor_voting", directions="fitted")
    np.testing.assert_allclose(found.k1, 1, atol=0.03)
    np.testing.assert_allclose(found.k2, 0, atol=0.2)
    np.testing.assert_allclose(found.k2[600:-600], 0, atol=2e-3)
    assert np.abs(found.d2[:, 2]).min() > 0.995
    flat = curvlib.estimate(graph(12, lambda x, y: 0.3 * x - y), "tensor_voting")
    np.testing.assert_allclose(flat.k1, 0, atol=1e-12)
    np.testing.assert_allclose(flat.k2, 0, atol=1e-12)


def test_undefined():
    """Votes from two directions, along the sides of a square, are too few, and those from none."""
    pyramid = [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 0.2]]
    sides = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    found = curvlib.estimate((pyramid, sides), "tensor_voting", radius=1.1)
    assert np.isnan(found.k1).all()
    assert np.isfinite(curvlib.estimate((pyramid, sides), "tensor_voting", radius=1.5).k1[:4]).all()
    alone = curvlib.estimate((pyramid, sides), "tensor_voting", radius=0.5)
    assert np.isnan(alone.H).all()


def errors(side, kind, per, **options):
    """Mean errors of K, H and the direction d1 on a torus."""
    vertices, faces = torus(side, kind)
    found = curvlib.estimate((vertices, faces), "tensor_voting", per=per, **options)
    x, y, _ = (vertices if per == "vertex" else vertices[faces].mean(1)).T
    r = np.hypot(x, y)
    k2, across = (r - 2) / r, np.abs(found.d1[:, 1] * x - found.d1[:, 0] * y) / r
    off = found.K - k2, found.H - (1 + k2) / 2, np.arcsin(np.minimum(across, 1))
    return np.array([np.abs(x).mean() for x in off])


@pytest.mark.parametrize("per", ["vertex", "face"])
def test_order(per):
    """Over five edges, with fitted directions: two on a coarse regular mesh; on an irregular one
    errors fall as far as coarse meshes are concerned. With uniform directions there is none, and at
    the vertices of a grid errors of K are large and grow."""
    coarse, fine = (errors(n, "regular", per, directions="fitted") for n in (32, 64))
    assert (np.log2(coarse / fine)[:2] > 1.8).all()
    coarse, fine = (errors(n, "irregular", per, directions="fitted") for n in (32, 64))
    assert (np.log2(coarse / fine)[:2] > 1).all()
    assert (fine < 0.02).all()
    uniform = errors(64, "irregular", per)
    assert uniform[2] > 10 * fine[2]
    assert (uniform < (0.06, 0.04, 0.15)).all()
    grid = [errors(n, "regular", per)[0] for n in (32, 64)]
    assert (grid[1] > grid[0] > 0.1) == (per == "vertex")


def test_order_on_fine_grids():
    """One in the mean: of opposite neighbours one may lie beyond the radius."""
    coarse, fine = (errors(n, "regular", "vertex", directions="fitted")[1] for n in (96, 256))
    assert 0.8 < np.log(coarse / fine) / np.log(256 / 96) < 1.5


def test_boundary():
    """Values by votes from inside are less accurate."""
    mesh = graph(24, lambda x, y: 0.2 * (x * x + y * y))
    found = curvlib.estimate(mesh, "tensor_voting", directions="fitted", radius="4 edges")
    x, y, _ = mesh.vertices.T
    H = -0.4 * (1 + 0.08 * (x * x + y * y)) / (1 + 0.16 * (x * x + y * y)) ** 1.5
    off = np.abs(found.H - H)
    assert np.isfinite(found.K).all()
    assert off[~mesh.boundary].mean() < 0.01
    assert off[mesh.boundary].mean() < 0.05


def test_weights():
    """exp(-3 x) by a polynomial."""
    x = np.linspace(0, 1, 1001)
    found = [tensor_voting._decay.py_func(each) for each in x]
    np.testing.assert_allclose(found, np.exp(-3 * x), rtol=1e-13)


def test_the_largest_eigenvector():
    """Of eigenvalues that differ by a millionth part; none where the largest is double."""
    rng = np.random.default_rng(4)
    for second in (0, 0.3, 0.999, 1 - 1e-6):
        axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        matrix = axes @ np.diag([1, second, second / 2]) @ axes.T
        found = np.array(tensor_voting._dominant.py_func(*matrix[np.triu_indices(3)]))
        assert abs(found @ axes[:, 0]) == pytest.approx(1, abs=1e-13)
    assert np.isnan(tensor_voting._dominant.py_func(1.0, 0.0, 0.0, 1.0, 0.0, 0.5)).all()
    with np.errstate(invalid="ignore", divide="ignore"):
        zero = np.float64(0)
        assert np.isnan(tensor_voting._dominant.py_func(*[zero] * 6)).all()


@pytest.mark.parametrize("per", ["vertex", "face"])
def test_any_number_of_threads_gives_the_same_bytes(monkeypatch, per):
    mesh = graph(20, wavy)
    alone = curvlib.estimate(mesh, "tensor_voting", per=per)
    monkeypatch.setattr("curvlib.meshes.loops.BLOCK", 7)
    for threads in (1, 3):
        again = curvlib.estimate(mesh, "tensor_voting", per=per, threads=threads)
        np.testing.assert_array_equal(again.k1, alone.k1)
        np.testing.assert_array_equal(again.d1, alone.d1)


def test_neighbours_at_a_distance_of_rounding_have_no_vote():
    """On the unit sphere, a triangle divided at a point that is its corner but for rounding."""
    sphere = pyvista.Sphere(theta_resolution=24, phi_resolution=12)
    vertices, faces = np.array(sphere.points, float), sphere.regular_faces
    vertices /= np.linalg.norm(vertices, axis=1)[:, None]
    a, b, c = faces[100]
    beside = vertices[a] + [2e-16, 1e-16, 2e-16]
    count = len(vertices)
    keep = [f for f in faces.tolist() if set(f) != {a, b, c}]
    parts = [[count, b, c], [a, count, c], [a, b, count]]
    mesh = np.vstack((vertices, beside)), np.array(keep + parts)
    found = curvlib.estimate(mesh, "tensor_voting", radius=1.0)
    near = curvlib.estimate((vertices, faces), "tensor_voting", radius=1.0)
    good = np.isfinite(found.H[:count])
    assert good.sum() >= count - 4
    np.testing.assert_allclose(found.H[:count][good], near.H[good], atol=0.2)
