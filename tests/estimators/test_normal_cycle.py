"""The normal cycle: closed forms of polyhedra, plain code, its order."""

import numpy as np
import pytest
from flood import Flood, length_inside
from scipy.spatial import Delaunay

import curvlib
from curvlib.meshes.jittered import graph, jittered, wavy
from curvlib.meshes.torus import torus


def test_over_one_ring_H_is_that_of_gauss_bonnet(ellipsoid):
    for mesh in (ellipsoid, curvlib.Mesh(*torus(20, "irregular"))):
        found = curvlib.estimate(mesh, "normal_cycle")
        np.testing.assert_allclose(found.H, curvlib.estimate(mesh, "gauss_bonnet").H, rtol=1e-12)


def roof(angle):
    """A plane over [-1, 1]^2 folded along x = 0, where the normal turns by an angle."""
    rng = np.random.default_rng(2)
    u = np.linspace(-1, 1, 15)
    x, y = (a.ravel() for a in np.meshgrid(u, u, indexing="ij"))
    free = rng.uniform(-0.05, 0.05, (2, len(x)))
    x, y = x + free[0] * (np.abs(x) % 1 > 1e-9), y + free[1] * (np.abs(y) < 1)
    faces = []
    for half in (np.flatnonzero(x <= 0), np.flatnonzero(x >= 0)):
        faces += list(half[Delaunay(np.column_stack((x, y))[half]).simplices])
    faces = np.array(faces)
    a, b, c = faces.T
    turned = (x[b] - x[a]) * (y[c] - y[a]) < (x[c] - x[a]) * (y[b] - y[a])
    faces[turned] = faces[turned, ::-1]
    folded = np.where(x > 0, x * np.cos(angle), x), y, np.where(x > 0, -x * np.sin(angle), 0)
    return curvlib.Mesh(np.column_stack(folded), faces)


@pytest.mark.parametrize("angle", [1.2, 0.3, -1.0])
@pytest.mark.parametrize("radius", [0.07, 0.21, 0.4])
def test_a_fold_between_two_planes(angle, radius):
    """Of length 2 sqrt(r^2 - d^2) in a ball at distance d from it: k = angle times length over the
    area of a disc without a segment and of a segment of another disc, across the fold."""
    mesh = roof(angle)
    found = curvlib.estimate(mesh, "normal_cycle", radius=radius)
    x, y, z = mesh.vertices.T
    distance = np.hypot(x, z)
    inner = (1 - np.abs(y) > radius) & (1 - distance > radius)
    meets = inner & (distance < radius)
    assert meets.sum() > 10
    d = distance[meets]
    length = 2 * np.sqrt(radius**2 - d**2)
    other = np.sqrt(radius**2 - (d * np.sin(angle)) ** 2)
    area = np.pi * radius**2 - segment(radius, d) + segment(other, d * np.cos(angle))
    k = angle * length / area
    np.testing.assert_allclose(found.H[meets], k / 2, rtol=1e-11)
    np.testing.assert_allclose(found.k1[meets], np.maximum(k, 0), atol=1e-11)
    np.testing.assert_allclose(found.k2[meets], np.minimum(k, 0), atol=1e-11)
    across = found.d1 if angle > 0 else found.d2
    np.testing.assert_allclose(across[meets, 1], 0, atol=1e-11)
    np.testing.assert_allclose(found.H[inner & ~meets], 0, atol=1e-11)


def segment(radius, d):
    """The area of a disc beyond a line at distance d from its centre."""
    return radius**2 * np.arccos(d / radius) - d * np.sqrt(radius**2 - d**2)


def test_a_corner_of_a_box():
    """Three edges of length r and three quarters of discs: k1 = k2 = 1 / r at any r below the
    sides; over one ring half of the edges and a third of the triangles."""
    corners = np.indices((2, 2, 2)).reshape(3, -1).T * (1.0, 2.0, 3.0)
    faces = [[0, 1, 3], [0, 3, 2], [4, 7, 5], [4, 6, 7], [0, 5, 1], [0, 4, 5]]
    faces += [[2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
    for r in (0.01, 0.6, 0.99):
        found = curvlib.estimate((corners, faces), "normal_cycle", radius=r)
        for values in (found.k1, found.k2, found.H):
            np.testing.assert_allclose(values, 1 / r, rtol=1e-7)
        np.testing.assert_allclose(found.K, 1 / r**2, rtol=1e-10)


@pytest.mark.parametrize("radius", [None, 0.1, 0.4])
def test_a_polyhedral_cylinder(radius):
    """k1 is the angle of its edges over the width of its sides; within a ball that reaches no
    other edge, over half of the circle's circumference over its diameter."""
    sides, rows = 12, 9
    i, j = np.divmod(np.arange(sides * rows), rows)
    turn = 2 * np.pi * i / sides
    vertices = np.column_stack((np.cos(turn), np.sin(turn), 0.3 * j))
    v = np.flatnonzero(j < rows - 1)
    w = (v + rows) % len(vertices)
    faces = np.vstack((np.column_stack((v, w, w + 1)), np.column_stack((v, w + 1, v + 1))))
    found = curvlib.estimate((vertices, faces), "normal_cycle", radius=radius)
    inner = (j > 1) & (j < rows - 2)
    k = 2 * np.pi / sides / (2 * np.sin(np.pi / sides) if radius is None else np.pi * radius / 2)
    np.testing.assert_allclose(found.k1[inner], k, rtol=1e-12)
    np.testing.assert_allclose(found.k2[inner], 0, atol=1e-12)
    np.testing.assert_allclose(np.abs(found.d2[inner, 2]), 1, rtol=1e-12)


def plain(flood, v, radius):
    """K, H, k1, k2 and d1 from the definition."""
    vertices, faces = flood.vertices - flood.vertices[v], flood.faces
    triangles, parts = flood.ball(v, radius)

    def normal(t):
        a, b, c = vertices[faces[t]]
        return np.cross(b - a, c - a)

    area = sum(part * np.linalg.norm(normal(t)) / 2 for t, part in zip(triangles, parts))
    tensor = np.zeros((3, 3))
    for t in triangles:
        for k in range(3):
            start, end = faces[t][k], faces[t][k - 2]
            other = flood.beyond.get((end, start))
            if other is None or start > end or (radius is None and v not in (start, end)):
                continue
            e = vertices[end] - vertices[start]
            length = np.linalg.norm(e)
            n, m = (normal(t) / np.linalg.norm(normal(t)) for t in (t, other))
            angle = np.arcsin(np.clip(np.linalg.norm(np.cross(n, m)), 0, 1))
            if n @ m < 0:
                angle = np.pi - angle
            angle *= np.sign(np.cross(n, m) @ e)
            if radius is not None:
                length = length_inside(vertices[start], vertices[end], radius)
            tensor += angle * length * np.outer(e, e) / (e @ e)
    tensor /= area if radius is not None else 2 * area / 3
    N = sum(normal(t) for t in flood.at[v])
    N /= np.linalg.norm(N)
    plane = np.eye(3) - np.outer(N, N)
    (low, high), axes = principal(plane @ tensor @ plane, N)
    H, gap = np.trace(tensor) / 2, (high - low) / 2
    return H * H - gap * gap, H, H + gap, H - gap, axes[:, 0]


def principal(form, N):
    """Eigenvalues and eigenvectors of a form in the plane normal to N, ascending."""
    values, axes = np.linalg.eigh(form)
    order = np.argsort(np.abs(axes.T @ N))[:2]
    order = order[np.argsort(values[order])]
    return values[order], axes[:, order]


@pytest.mark.parametrize("radius", [None, 0.15, 0.5, 0.9])
@pytest.mark.parametrize("open_", [True, False])
def test_against_plain_code(open_, radius):
    mesh = graph(12, wavy) if open_ else curvlib.Mesh(*torus(20, "irregular"))
    found, flood = curvlib.estimate(mesh, "normal_cycle", radius=radius), Flood(mesh)
    for v in range(0, len(mesh.vertices), 7):
        K, H, k1, k2, d1 = plain(flood, v, radius)
        assert found.K[v] == pytest.approx(K, abs=1e-10)
        assert found.H[v] == pytest.approx(H, abs=1e-11)
        assert (found.k1[v], found.k2[v]) == pytest.approx((k1, k2), abs=1e-9)
        if k1 - k2 > 1e-3:
            assert abs(found.d1[v] @ d1) == pytest.approx(1, abs=1e-9)


def test_order_where_the_radius_shrinks_as_the_root_of_the_edges():
    """In the mean, on a torus and a patch: at least the O(sqrt(edge)) that is proven."""
    for surface in ("torus", "patch"):
        errors = []
        for n in (32, 64, 128):
            mesh = jittered(surface, n)
            found = curvlib.estimate(mesh, "normal_cycle", radius=(2 / n) ** 0.5)
            inner = (np.abs(mesh.vertices[:, :2]) < 0.7).all(1) | (surface == "torus")
            off = (np.abs(getattr(found, q) - getattr(mesh, q)) for q in ("K", "H", "k1", "k2"))
            errors.append([e[inner].mean() for e in off])
        slopes = np.log2(np.divide(errors[0], errors[2])) / 2
        assert (slopes > 0.65).all(), slopes


def test_a_fold_onto_itself_has_no_angle():
    """Also far from the vertex; not where the radius does not reach it."""
    mesh = roof(0.0)
    x, y, z = mesh.vertices.T
    folded = curvlib.Mesh(np.column_stack((np.where(x > 0, -0.9 * x, x), y, z)), mesh.faces)
    found = curvlib.estimate(folded, "normal_cycle", radius=0.3)
    inner = np.abs(y) < 0.65
    np.testing.assert_array_equal(np.isnan(found.H[inner]), np.abs(folded.vertices[inner, 0]) < 0.3)


def test_a_triangle_alone_has_no_angle():
    """NaN at a corner in one triangle, since no edge between two of them is near; 0 at others."""
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]), [[0, 1, 2], [0, 2, 3]]
    for radius in (None, 0.3):
        found = curvlib.estimate(square, "normal_cycle", radius=radius)
        for values in (found.K, found.H, found.k1, found.k2):
            np.testing.assert_array_equal(values, [0, np.nan, 0, np.nan])
    np.testing.assert_array_equal(curvlib.estimate(square, "normal_cycle", radius=0.8).H, 0)
