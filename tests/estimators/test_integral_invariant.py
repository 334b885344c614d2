"""Integral invariant: expansions, closed forms, orders, where it is defined."""

import numpy as np
import pytest
import pyvista

import curvlib
from curvlib.meshes.torus import torus


def test_the_expansion_of_the_covariance():
    """Of the solid below z = -(k1 x^2 + k2 y^2) / 2: the terms in r^5 and r^6, by quadrature that
    is exact for these polynomials."""
    r, k1, k2 = 0.7, 1.3, -0.4
    nodes, weights = np.polynomial.legendre.leggauss(6)
    rho, phi = np.meshgrid(r / 2 * (1 + nodes), np.pi / 8 * np.arange(16))
    x, y, area = rho * np.cos(phi), rho * np.sin(phi), rho * np.pi / 8 * r / 2 * weights

    def change(f):
        """Of the integral over a half-ball, to first order in the height."""
        return -(f * (k1 * x * x + k2 * y * y) / 2 * area).sum()

    xx, yy = (2 * np.pi * r**5 / 15 + change(v * v) for v in (x, y))
    assert change(x * y) == pytest.approx(0, abs=1e-14)
    assert xx == pytest.approx(2 * np.pi * r**5 / 15 - np.pi * r**6 * (3 * k1 + k2) / 48)
    assert 6 / (np.pi * r**6) * (yy - 3 * xx) + 8 / (5 * r) == pytest.approx(k1)
    assert change(1) == pytest.approx(-np.pi * r**4 * (k1 + k2) / 8)


def own(points, faces, v, r, depth=4):
    """The six by eigenvectors of the covariance about the barycentre (Pottmann et al. 2009), the
    moments by midpoint sums over cones from the vertex to the faces of a closed mesh."""
    corners = (points - points[v])[faces]
    for _ in range(depth):
        a, b, c = corners.transpose(1, 0, 2)
        p, q, s = (a + b) / 2, (b + c) / 2, (c + a) / 2
        parts = (a, p, s), (p, b, q), (s, q, c), (p, q, s)
        corners = np.concatenate([np.stack(t, 1) for t in parts])
    a, b, c = corners.transpose(1, 0, 2)
    x, f = (a + b + c) / 3, np.cross(b - a, c - a) / 2
    distance = np.linalg.norm(x, axis=1)
    angle, n, reach = (x * f).sum(1) / distance**3, x / distance[:, None], np.minimum(distance, r)
    volume, first = (angle * reach**3 / 3).sum(), (angle * reach**4 / 4) @ n
    M = np.einsum("k,ki,kj->ij", angle * reach**5 / 5, n, n) - np.outer(first, first) / volume
    values, axes = np.linalg.eigh(M)
    one, two = values[1:]
    k1, k2 = (6 / (np.pi * r**6) * (q - 3 * p) + 8 / (5 * r) for p, q in ((one, two), (two, one)))
    return k1, k2, axes[:, 1], axes[:, 2]


def test_against_the_eigenvalues_of_the_paper():
    """On an ellipsoid: the same curvatures but for terms of higher order, which are small."""
    mesh = curvlib.tessellate(curvlib.surface("ellipsoid"), 24, "random", seed=5)
    found = curvlib.estimate(mesh, "integral_invariant", radius=0.4)
    for v in range(3, len(mesh.vertices), 53):
        k1, k2, d1, d2 = own(mesh.vertices, mesh.faces, v, 0.4)
        np.testing.assert_allclose((found.k1[v], found.k2[v]), (k1, k2), atol=0.005 * k1)
        if k1 - k2 > 0.2 * k1:
            assert abs(d1 @ found.d1[v]) > 0.999
            assert abs(d2 @ found.d2[v]) > 0.999
        assert found.K[v] == pytest.approx(found.k1[v] * found.k2[v], rel=1e-12)
        assert found.H[v] == pytest.approx((found.k1[v] + found.k2[v]) / 2, rel=1e-12)


def icosphere(nsub):
    ball = pyvista.Icosphere(radius=1, nsub=nsub)
    return ball.points / np.linalg.norm(ball.points, axis=1)[:, None].astype(float)


def test_spheres():
    """k1 = k2 = 1 - r^2 / 16 for radius 1, to O(h^2) at a fixed r, with the error that the
    docstring states."""
    errors = []
    for nsub in (3, 4, 5):
        points, r = icosphere(nsub), 0.8
        mesh = curvlib.Mesh(points, pyvista.Icosphere(radius=1, nsub=nsub).regular_faces)
        found = curvlib.estimate(mesh, "integral_invariant", radius=r)
        assert np.abs(found.k1 - found.k2).max() < 0.02 / 4 ** (nsub - 3)
        errors.append((found.H - 1 + r * r / 16).mean())
        assert errors[-1] == pytest.approx(3 * mesh.mean_edge**2 / (8 * r * r), rel=0.1)
    assert np.log2(np.divide(errors[:-1], errors[1:])).min() > 1.9


def test_a_plane_and_its_boundary():
    """Zero where the ball meets no edge of the boundary, else NaN."""
    rng, n = np.random.default_rng(4), 21
    i, j = np.divmod(np.arange(n * n), n)
    inner = (i > 0) & (i < n - 1) & (j > 0) & (j < n - 1)
    points = np.stack((i, j), 1) + 0.3 * inner[:, None] * rng.uniform(-1, 1, (n * n, 2))
    a = np.arange(n * n).reshape(n, n)[:-1, :-1].ravel()
    faces = np.vstack((np.stack((a, a + n, a + n + 1), 1), np.stack((a, a + n + 1, a + 1), 1)))
    tilted = points @ [[0.6, 0.0, 0.8], [0.0, 1.0, 0.0]]
    found = curvlib.estimate((tilted, faces), "integral_invariant", radius=3.5)
    near = np.minimum(points, n - 1 - points).min(1) < 3.5
    np.testing.assert_array_equal(np.isnan(found.H), near)
    assert np.abs(np.r_[found.k1, found.k2][np.r_[~near, ~near]]).max() < 1e-12


def test_sheets_that_are_not_connected_within_the_ball():
    """A thin plate has the values of a plane, but near its rim, where it is connected."""
    n = 15
    grid = np.stack(np.meshgrid(*[np.arange(n)] * 2, indexing="ij"), -1).reshape(-1, 2)
    top = np.column_stack((grid, np.zeros(len(grid))))
    a = np.arange(n * n).reshape(n, n)[:-1, :-1].ravel()
    upper = np.vstack((np.stack((a, a + n, a + n + 1), 1), np.stack((a, a + n + 1, a + 1), 1)))
    count = len(top)
    edges = {(p, q) for f in upper for p, q in zip(f, np.roll(f, -1))}
    rim = [(p, q) for p, q in edges if (q, p) not in edges]
    wall = [t for p, q in rim for t in ((q, p, p + count), (q, p + count, q + count))]
    mesh = curvlib.Mesh(
        np.vstack((top, top - (0, 0, 0.4))), np.vstack((upper, upper[:, ::-1] + count, wall))
    )
    assert mesh.closed.all()
    H = curvlib.estimate(mesh, "integral_invariant", radius=2.5).H[:count]
    far = np.minimum(grid, n - 1 - grid).min(1) > 2.5
    assert np.abs(H[far]).max() < 1e-12
    assert H[~far].min() > 0.05


def test_a_mesh_within_the_ball_is_undefined():
    """But not one that reaches out of it somewhere."""
    points, faces = icosphere(1), pyvista.Icosphere(radius=1, nsub=1).regular_faces
    assert np.isnan(curvlib.estimate((points, faces), "integral_invariant", radius=2.01).H).all()
    assert np.isfinite(curvlib.estimate((points, faces), "integral_invariant", radius=1.9).H).all()


def on_torus(side, radius, noise=0.0):
    """Mean errors of k1, k2, K and H, and of the direction d1 in radians, on a torus of radii 2
    and 1; `radius` is a function of the mean edge, `noise` is in mean edges."""
    vertices, faces = torus(side, "irregular")
    around = np.hypot(*vertices[:, :2].T)
    k2, h = (around - 2) / around, curvlib.Mesh(vertices, faces).mean_edge
    across = np.stack((-vertices[:, 1], vertices[:, 0], 0 * around), 1) / around[:, None]
    shifts = noise * h * np.random.default_rng(1).normal(size=vertices.shape)
    r = curvlib.estimate((vertices + shifts, faces), "integral_invariant", radius=radius(h))
    pairs = (r.k1, 1), (r.k2, k2), (r.K, k2), (r.H, (1 + k2) / 2)
    angle = np.arcsin(np.minimum(np.abs((r.d1 * across).sum(1)), 1))
    return np.array([*(np.abs(a - b).mean() for a, b in pairs), angle.mean()])


def test_order_on_an_irregular_torus():
    """For r^2 = h; and none for r of 5 edges, where vertices stand out from the solid."""
    coarse, fine = (on_torus(side, np.sqrt) for side in (64, 128))
    assert (np.log2(coarse / fine) > 0.9).all()
    fixed = on_torus(192, lambda h: 5 * h)
    assert 0.004 < fixed[3] < 0.008
    assert fixed[4] < 0.001


def test_noise():
    """Of a tenth of an edge: an error e of the vertex along its normal makes 3 e / r^2 of H."""
    h = curvlib.Mesh(*torus(96, "irregular")).mean_edge
    expected = 3 * 0.1 * h * np.sqrt(2 / np.pi) / (5 * h) ** 2
    assert on_torus(96, lambda h: 5 * h, noise=0.1)[3] == pytest.approx(expected, rel=0.15)
