"""Corrected measures: spheres, plain code with each kind of normals, orders, input."""

import numpy as np
import pytest
from flood import Flood

import curvlib
from curvlib.meshes.jittered import graph, jittered, wavy

KINDS = ["area", "fit", "ball", "given"]


def estimate(mesh, **options):
    return curvlib.estimate(mesh, "corrected_measures", **options)


@pytest.mark.parametrize("radius", [None, 0.3, "5 edges"])
def test_a_sphere_with_exact_normals_is_exact(sphere, radius):
    found = estimate(sphere, normals="given", radius=radius)
    np.testing.assert_allclose(found.K, 1, rtol=1e-12)
    np.testing.assert_allclose(found.H, 1, rtol=1e-12)
    np.testing.assert_allclose(found.k1, 1, rtol=1e-6)


def area_vectors(mesh):
    """The mean normal of the triangles at each vertex, as long as a third of their area."""
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    facets = np.cross(b - a, c - a)
    normals, areas = np.zeros_like(mesh.vertices), np.zeros(len(mesh.vertices))
    for k in range(3):
        np.add.at(normals, mesh.faces[:, k], facets)
        np.add.at(areas, mesh.faces[:, k], np.linalg.norm(facets, axis=1) / 6)
    return unit(normals) * areas[:, None]


def unit(x):
    return x / np.linalg.norm(x, axis=-1, keepdims=True)


def within(mesh, radius):
    """(V, V) bool: two edges apart, or connected within a radius (here: all at that distance)."""
    if radius is not None:
        x = mesh.vertices
        return np.linalg.norm(x[:, None] - x, axis=2) <= radius
    near = np.eye(len(mesh.vertices), dtype=int)
    for k in range(3):
        near[mesh.faces[:, k], mesh.faces[:, k - 1]] = 1
        near[mesh.faces[:, k - 1], mesh.faces[:, k]] = 1
    return near @ near > 0


def normals_of(mesh, kind, radius):
    """The normals (V, 3) of each kind."""
    if kind == "given":
        return mesh.normals
    vectors, out = area_vectors(mesh), []
    if kind == "area":
        return unit(vectors)
    for v, near in enumerate(within(mesh, radius)):
        e = mesh.vertices[near] - mesh.vertices[v]
        squares = (e * e).sum(1)
        if kind == "ball":
            weights = 1 - squares / (radius**2 if radius else squares.max())
            out.append(unit(weights @ vectors[near]))
            continue
        N = unit(vectors[v])
        X = unit(np.cross(N, np.eye(3)[np.abs(N).argmin()]))
        Y = np.cross(N, X)
        x, y, z = e @ X, e @ Y, e @ N
        powers = [(s - j, j) for s in range(4) for j in range(s + 1)]
        columns = np.column_stack([x**i * y**j for i, j in powers])
        _, p, q, *_ = np.linalg.lstsq(columns, z, rcond=None)[0]
        out.append(unit(N - p * X - q * Y))
    return np.array(out)


def plain(flood, v, radius, normals):
    """K, H and the directions' tensor from the paper's formulas, with coordinates as they are."""
    mu = np.zeros(3)
    tensor, axes = np.zeros((3, 3)), np.eye(3)
    for t, part in zip(*flood.ball(v, radius)):
        a, b, c = flood.vertices[flood.faces[t]]
        ua, ub, uc = normals[flood.faces[t]]
        u = (ua + ub + uc) / 3
        bent = np.cross(uc - ub, a) + np.cross(ua - uc, b) + np.cross(ub - ua, c)
        mu += part / 2 * np.array([u @ np.cross(b - a, c - a), u @ bent, ua @ np.cross(ub, uc)])
        for i, x in enumerate(axes):
            for j, y in enumerate(axes):
                turned = y @ (uc - ua) * np.cross(x, b - a) - y @ (ub - ua) * np.cross(x, c - a)
                tensor[i, j] += part / 2 * u @ turned
    return mu[2] / mu[0], mu[1] / (2 * mu[0]), -(tensor + tensor.T) / (2 * mu[0])


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("radius", [None, 0.9])
@pytest.mark.parametrize("open_", [True, False])
def test_against_plain_code(kind, radius, open_):
    if open_:
        mesh = graph(12, wavy)
        normals = unit(np.random.default_rng(0).normal((0, 0, 1), 0.1, mesh.vertices.shape))
        mesh = curvlib.Mesh(mesh.vertices, mesh.faces, normals=normals)
    else:
        mesh = jittered("torus", 30)
    found, flood = estimate(mesh, normals=kind, radius=radius), Flood(mesh)
    normals = normals_of(mesh, kind, radius)
    corner = np.bincount(mesh.faces.ravel()) < 3
    for v in range(0, len(mesh.vertices), 1 + len(mesh.vertices) // 20):
        K, H, tensor = plain(flood, v, radius, normals)
        if kind == "fit" and corner[flood.faces[flood.ball(v, radius)[0]]].any():
            continue  # a corner of the patch has neighbours for a polynomial of lower degree
        assert found.K[v] == pytest.approx(min(K, H * H), abs=1e-8)
        assert found.H[v] == pytest.approx(H, abs=1e-8)
        plane = np.eye(3) - np.outer(normals[v], normals[v])
        form = plane @ tensor @ plane
        d1, d2 = found.d1[v], found.d2[v]
        assert d1 @ form @ d1 >= d2 @ form @ d2
        assert d1 @ form @ d2 == pytest.approx(0, abs=1e-7)
        np.testing.assert_allclose(np.cross(d1, d2), normals[v], atol=1e-7)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("radius", [None, "4 edges"])
def test_principal_values_are_those_of_K_and_H(ellipsoid, kind, radius):
    """Also where the sums of the measures have H^2 < K."""
    for noise in (0, 0.02):
        shift = np.random.default_rng(1).normal(0, noise, ellipsoid.vertices.shape)
        vertices, faces = ellipsoid.vertices + shift, ellipsoid.faces
        mesh = curvlib.Mesh(vertices, faces, normals=ellipsoid.normals)
        found = estimate(mesh, normals=kind, radius=radius)
        assert (found.k1 >= found.k2).all()
        np.testing.assert_allclose(found.k1 * found.k2, found.K, atol=1e-12)
        np.testing.assert_allclose(found.k1 + found.k2, 2 * found.H, atol=1e-12)


@pytest.mark.parametrize(
    ("kind", "radius", "order"),
    [
        ("given", None, 1),
        ("fit", None, 1),
        ("given", "3 edges", 2),
        ("fit", "3 edges", 2),
        ("given", "root", 1),
        ("area", "root", 1),
        ("ball", "root", 1),
    ],
)
def test_order_on_irregular_meshes(kind, radius, order):
    """Of K and H inside; "root": radius^2 ~ edge."""
    errors = []
    for n in (33, 65, 129):
        mesh = jittered("patch", n)
        length = (2 / (n - 1)) ** 0.5 if radius == "root" else radius
        found = estimate(mesh, normals=kind, radius=length)
        x, y, _ = mesh.vertices.T
        inner = (np.abs(x) < 0.7) & (np.abs(y) < 0.7)
        off = np.abs(found.K - mesh.K), np.abs(found.H - mesh.H)
        errors.append([e[inner].mean() for e in off])
    slopes = np.log2(np.divide(errors[0], errors[2])) / 2
    assert (slopes > order - 0.2).all(), slopes


def test_over_one_ring_with_normals_by_area_errors_stay():
    meshes = jittered("torus", 32), jittered("torus", 96)
    errors = [np.abs(estimate(mesh).H - mesh.H).mean() for mesh in meshes]
    assert errors[1] > 0.7 * errors[0]


def test_given_needs_normals(sphere):
    bare = curvlib.Mesh(sphere.vertices, sphere.faces)
    with pytest.raises(curvlib.InputError, match="normals='given' needs a mesh with normals"):
        estimate(bare, normals="given")


@pytest.mark.parametrize("radius", [None, "3 edges"])
def test_a_triangle_with_a_corner_without_normal_is_left_out(radius):
    """The apex of a cone: no value there, and one at each vertex beside it."""
    mesh = curvlib.tessellate(curvlib.surface("cone_apex"), 8)
    lacking = np.isnan(mesh.normals).any(1)
    assert lacking.sum() == 1
    for values in estimate(mesh, normals="given", radius=radius):
        np.testing.assert_array_equal(np.isnan(values), lacking)
