"""Agreement with an independent implementation, with other libraries and with closed forms."""

import itertools

import numpy as np
import pytest
import pyvista
import reference

import curvlib
from curvlib.claims.cell import NINE as PAPER
from curvlib.meshes.torus import torus
from curvlib.signatures import readings


@pytest.mark.parametrize("surface", curvlib.surfaces())
def test_reference_agrees(surface):
    """All nine, default readings, at n = 16, to 1e-9."""
    m = curvlib.tessellate(curvlib.surface(surface), 16)
    size = np.nanmax(np.abs(m.k1))
    for name in PAPER:
        found = curvlib.estimate(m, name)
        expected = reference.estimate(m.vertices, m.faces, name)
        for a, b, power in zip(found, expected, (2, 1)):
            np.testing.assert_array_equal(np.isnan(a), np.isnan(b))
            np.testing.assert_allclose(a, b, rtol=1e-9, atol=1e-12 * size**power, err_msg=name)


@pytest.mark.parametrize("name", PAPER)
def test_reference_agrees_in_every_reading(name):
    """On rings of valence 3 to 9 of a saddle-shaped and strongly curved surface."""
    m = curvlib.tessellate(curvlib.surface("teapot_spout"), 10, "random", seed=2)
    some = np.flatnonzero(~m.boundary & m.smooth)[::3]
    options = readings(name)
    for values in itertools.product(*options.values()):
        if "as-printed" in values:
            continue  # what comes of the misprints is tested with the claims
        chosen = {k: v for k, v in zip(options, values) if k != "principal"}
        found = curvlib.estimate(m, name, **chosen)
        expected = reference.estimate(
            m.vertices, m.faces, name, normals=m.normals, only=some, **chosen
        )
        for a, b in zip(found, expected):
            np.testing.assert_allclose(a[some], b[some], rtol=1e-9, err_msg=str(chosen))


@pytest.mark.parametrize("name", PAPER)
def test_reference_agrees_on_irregular_rings(name):
    """Jittered Delaunay triangles of a torus: to 1e-12 of the largest value."""
    vertices, faces = torus(12, "irregular")
    for a, b in zip(
        curvlib.estimate((vertices, faces), name), reference.estimate(vertices, faces, name)
    ):
        np.testing.assert_allclose(a, b, rtol=0, atol=1e-12 * np.abs(b).max())


@pytest.mark.parametrize("surface", ["sphere", "ellipsoid"])
def test_pyvista_has_the_same_angle_deficit(surface):
    m = curvlib.tessellate(curvlib.surface(surface), 24)
    padded = np.column_stack((np.full(len(m.faces), 3), m.faces)).ravel()
    theirs = pyvista.PolyData(m.vertices, padded).curvature("gaussian")
    ours = curvlib.estimate(m, "gauss_bonnet").K
    np.testing.assert_allclose(ours, theirs, rtol=1e-10)


def test_total_curvature_is_that_of_gauss_and_bonnet():
    """The deficits K A / 3 sum to 2 pi chi, exactly, on any closed mesh."""
    m = curvlib.tessellate(curvlib.surface("ellipsoid"), 9, "random", seed=1)
    triangles = m.vertices[m.faces]
    areas = np.linalg.norm(
        np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1
    )
    A = np.bincount(m.faces.ravel(), np.repeat(areas / 2, 3))
    total = (curvlib.estimate(m, "gauss_bonnet").K * A / 3).sum()
    assert total == pytest.approx(4 * np.pi, rel=1e-12)
    half = curvlib.estimate(m, "gauss_bonnet", area="half")
    np.testing.assert_allclose(half.K * 3 / 2, curvlib.estimate(m, "gauss_bonnet").K, rtol=1e-13)


def ring_of_four(k1, k2, turn, eps=0.0):
    """A vertex of z = -(k1 x^2 + k2 y^2) / 2 and four neighbours in two straight pairs."""
    angle = turn + np.array([0, 0.5, 1, 1.5]) * np.pi + [0, 0, 0, eps]
    h = np.array([0.1, 0.2, 0.1, 0.2])
    x, y = h * np.cos(angle), h * np.sin(angle)
    z = -(k1 * np.cos(angle - turn) ** 2 + k2 * np.sin(angle - turn) ** 2) * h**2 / 2
    vertices = np.vstack(([0, 0, 0], np.column_stack((x, y, z))))
    return vertices, np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]])


@pytest.mark.parametrize("turn", [0, 0.4, 1.1])
@pytest.mark.parametrize("eps", [0.0, 1e-12, 1e-9])
def test_undetermined_paraboloid_takes_the_least_form(turn, eps):
    """Four neighbours in two straight pairs leave b open: the least norm has b = 0 along the
    pairs, whatever the frame, and nearly straight pairs do not blow up."""
    r = curvlib.estimate(ring_of_four(2.0, -0.5, turn, eps), "paraboloid")
    assert r.K[0] == pytest.approx(-1.0, rel=1e-5)
    assert r.H[0] == pytest.approx(0.75, rel=1e-5)


@pytest.mark.parametrize("length", [1, 30, 100, 1000])
@pytest.mark.parametrize("normal", ["uniform", "area"])
def test_paraboloid_on_long_triangles(length, normal):
    """A right cylinder of radius 1 with edges along its axis that are longer than the others: the
    form of a circle of chord d is 1/2 to d^2 / 8."""
    n = 4096
    angle = 2 * np.pi * np.arange(n) / n
    z = length * 2 * np.pi / n * np.arange(3)
    x, y = np.cos(angle), np.sin(angle)
    turn = pyvista.transformations.axis_angle_rotation((1, 2, 3), 50)[:3, :3]
    vertices = np.vstack([np.column_stack((x, y, 0 * x + level)) for level in z]) @ turn.T
    at = np.arange(3 * n).reshape(3, n)
    a, b = at[:-1], np.roll(at, -1, axis=1)[:-1]
    c, d = np.roll(at, -1, axis=1)[1:], at[1:]
    faces = np.concatenate([np.stack(f, -1).reshape(-1, 3) for f in ((a, b, c), (a, c, d))])
    r = curvlib.estimate((vertices, faces), "paraboloid", normal=normal)
    np.testing.assert_allclose(r.H[at[1]], 0.5, atol=1e-6)
    np.testing.assert_allclose(r.K[at[1]], 0, atol=1e-6)


@pytest.mark.parametrize("turn", [0, 0.4, 1.1])
def test_a_term_known_to_rounding_alone_does_not_decide(turn):
    """A cross whose arms are bent by what float32 or a printed decimal rounds, at all depths."""
    for eps in (1e-7, 1e-5, 1e-4):
        vertices, faces = ring_of_four(2.0, -0.5, turn, eps)
        vertices[1, 2] += eps * 0.01
        r = curvlib.estimate((vertices, faces), "paraboloid")
        assert r.K[0] == pytest.approx(-1.0, rel=0.02)
        assert r.H[0] == pytest.approx(0.75, rel=0.02)


@pytest.mark.parametrize("pairs", ["opposite", "all"])
def test_circles_do_not_hang_on_float32(pairs):
    """Right angles turned, moved and rounded to float32: the same circles are taken."""
    ring = np.array([[-3.4, 0, 0], [0, 0, 4.5], [1.5, -1.5, 0], [0, 0, -4.5]])
    faces = np.array([[0, 2, 1], [0, 3, 2], [0, 4, 3], [0, 1, 4]])
    rng, found = np.random.default_rng(0), []
    for _ in range(50):
        q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        q *= np.sign(np.linalg.det(q))
        vertices = np.vstack(([0, 0, 0], ring)) @ q.T + rng.uniform(-3, 3, 3)
        K = curvlib.estimate((vertices.astype(np.float32), faces), "circular", pairs=pairs).K
        found.append(K[0])
    np.testing.assert_allclose(found, np.mean(found), atol=1e-4)


def test_many_circles_are_fitted_in_parts():
    """780 pairs at valence 40, at irregular angles."""
    rng = np.random.default_rng(0)
    angle = np.sort(rng.uniform(0, 2 * np.pi, 40))
    x, y = np.cos(angle), np.sin(angle)
    rim = 0.1 * np.column_stack((x, y, -0.1 * (2 * x * x - 0.5 * y * y) / 2))
    vertices = np.vstack(([0, 0, 0], rim))
    k = np.arange(40)
    faces = np.column_stack((np.zeros(40, int), k + 1, (k + 1) % 40 + 1))
    found = curvlib.estimate((vertices, faces), "circular", pairs="all")
    expected = reference.estimate(vertices, faces, "circular", only=[0], pairs="all")
    np.testing.assert_allclose((found.K[0], found.H[0]), [x[0] for x in expected], rtol=1e-10)
