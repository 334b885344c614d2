"""Moments of solids in a ball, against closed forms, quadrature and other triangles of the same
surface."""

import numpy as np
import pytest
import pyvista
from scipy.integrate import quad

import curvlib
from curvlib.kit.options import Length
from curvlib.kit.solid import solid
from curvlib.kit.tensor import Curvatures


def ten(ball, radius: Length = 1.0):
    """The ten numbers of a Solid in the place of curvatures, for meshes of unit 1."""
    volume, first, second = solid(ball)
    xx, xy, xz, yy, yz, zz = second
    return Curvatures(volume, yy, yz, zz, first, (xx, xy, xz))


def moments(vertices, faces, v, radius):
    """Volume, first (3,) and second moments (3, 3) at a vertex."""
    found = curvlib.estimate((vertices, faces), ten, radius=radius)
    (xx, xy, xz), yy, yz, zz = found.d2[v], found.H[v], found.k1[v], found.k2[v]
    return found.K[v], found.d1[v], np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def assert_moments(found, expected, tolerance=1e-12):
    for a, b in zip(found, expected):
        np.testing.assert_allclose(a, b, rtol=tolerance, atol=tolerance)


def box(*sides):
    """A box with a corner at the origin, which is vertex 0."""
    x, y, z = (np.array(side, float) for side in sides)
    vertices = np.array([(a, b, c) for a in x for b in y for c in z])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    return vertices, faces


def turn(seed):
    q, r = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q * np.sign(np.linalg.det(q))


def refined(vertices, faces, rng, number):
    """The same surface with more triangles: points put into triangles or onto edges, at random."""
    vertices, faces = list(vertices), [list(map(int, f)) for f in faces]
    for _ in range(number):
        t, new = rng.integers(len(faces)), len(vertices)
        a, b, c = faces[t]
        if rng.random() < 0.5:
            vertices.append(rng.dirichlet([1, 1, 1]) @ np.array([vertices[i] for i in (a, b, c)]))
            faces[t] = [a, b, new]
            faces += [[b, c, new], [c, a, new]]
        else:
            s = rng.random()
            vertices.append((1 - s) * vertices[a] + s * vertices[b])
            faces[t] = [a, new, c]
            faces.append([new, b, c])
            for i, f in enumerate(faces):
                k = next((k for k in range(3) if (f[k], f[(k + 1) % 3]) == (b, a)), None)
                if k is not None:
                    faces[i] = [b, new, f[(k + 2) % 3]]
                    faces.append([new, a, f[(k + 2) % 3]])
                    break
    return np.array(vertices), np.array(faces)


@pytest.mark.parametrize("seed", range(4))
def test_a_corner_of_a_box(seed):
    """An eighth of a ball, whatever the triangles; sides of the box may touch the sphere."""
    rng, r = np.random.default_rng(seed), (2.0, 1.3)[seed % 2]
    vertices, faces = refined(*box((0, 2), (0, 2), (0, 2)), rng, 40 * seed)
    eighth = np.pi * r**3 / 6, np.full(3, np.pi * r**4 / 16)
    second = r**5 * (np.eye(3) * (np.pi / 30 - 1 / 15) + 1 / 15)
    assert_moments(moments(vertices, faces, 0, r), (*eighth, second))
    hollow = moments(vertices, faces[:, ::-1], 0, r)
    whole = 4 * np.pi * r**3 / 3, np.zeros(3), np.eye(3) * 4 * np.pi * r**5 / 15
    assert_moments(hollow, [a - b for a, b in zip(whole, (*eighth, second))])


@pytest.mark.parametrize("angle", [0.05, 1.0, np.pi / 2, 3.0, np.pi, 4.0, 6.2])
def test_a_wedge(angle):
    """Of two planes that meet in the z axis, jittered triangles on both, turned in space."""
    rng, r = np.random.default_rng(int(10 * angle)), 1.0
    n = 11
    i, j = np.divmod(np.arange(n * n), n)
    t, z = (i - n // 2) * 0.3, (j - n // 2) * 0.3
    t = t + 0.1 * rng.uniform(-1, 1, n * n) * (t != 0)
    z = z + 0.1 * rng.uniform(-1, 1, n * n) * ((t != 0) | (j != n // 2))
    one = np.stack((t, 0 * t, z), 1)
    other = np.stack((-t * np.cos(angle), -t * np.sin(angle), z), 1)
    vertices = np.where((t >= 0)[:, None], one, other)
    a = np.arange(n * n).reshape(n, n)[:-1, :-1].ravel()
    faces = np.vstack((np.stack((a, a + n, a + n + 1), 1), np.stack((a, a + n + 1, a + 1), 1)))
    c, s = np.cos(angle), np.sin(angle)
    xx, yy = angle / 2 + s * c / 2, angle / 2 - s * c / 2
    second = np.diag([4 / 3 * xx, 4 / 3 * yy, 2 * angle / 3])
    second[0, 1] = second[1, 0] = 2 / 3 * s * s
    R = turn(5)
    expected = 2 * angle / 3, R @ np.array([s, 1 - c, 0]) * np.pi / 8, R @ second @ R.T / 5
    assert_moments(moments(vertices @ R.T, faces, n * n // 2, r), expected)


def prism(r, low):
    """Moments of x, y in the unit square, z within the sphere and above `low` (0 or -inf)."""

    def integral(i, j, k):
        def along(x, y):
            top = np.sqrt(r * r - x * x - y * y) ** (k + 1) / (k + 1)
            return top * (1 if low == 0 else 2 * (k % 2 == 0))

        return quad(lambda x: x**i * quad(lambda y: y**j * along(x, y), 0, 1)[0], 0, 1)[0]

    e = np.eye(3, dtype=int)
    first = np.array([integral(*a) for a in e])
    return integral(0, 0, 0), first, np.array([[integral(*(a + b)) for b in e] for a in e])


@pytest.mark.parametrize("r", [1.5, 2.5])
def test_a_prism_thinner_than_the_ball(r):
    """Cut in one closed curve at its end, in two in its middle, and the hole of the same shape."""
    rng = np.random.default_rng(2)
    vertices, faces = refined(*box((0, 1), (0, 1), (0, 4)), rng, 60)
    assert_moments(moments(vertices, faces, 0, r), prism(r, 0), 1e-9)
    upper, lower = vertices, vertices * (1, 1, -1)
    half = faces[~(vertices[faces][:, :, 2] == 0).all(1)]
    both = np.vstack((upper, lower)), np.vstack((half, half[:, ::-1] + len(upper)))
    joined, index = np.unique(np.round(both[0], 14), axis=0, return_inverse=True)
    long, v = index.ravel()[both[1]], index.ravel()[0]
    expected = prism(r, -np.inf)
    assert_moments(moments(joined, long, v, r), expected, 1e-9)
    whole = 4 * np.pi * r**3 / 3, np.zeros(3), np.eye(3) * 4 * np.pi * r**5 / 15
    hole = [a - b for a, b in zip(whole, expected)]
    assert_moments(moments(joined, long[:, ::-1], v, r), hole, 1e-9)


def cones(vertices, faces, v, r, depth):
    """Moments of the cones from a vertex to the faces, cut by the ball: midpoint sums over 4^depth
    parts of each face."""
    corners = (vertices - vertices[v])[faces]
    for _ in range(depth):
        a, b, c = corners.transpose(1, 0, 2)
        p, q, s = (a + b) / 2, (b + c) / 2, (c + a) / 2
        corners = np.concatenate(
            [np.stack(t, 1) for t in ((a, p, s), (p, b, q), (s, q, c), (p, q, s))]
        )
    a, b, c = corners.transpose(1, 0, 2)
    x, f = (a + b + c) / 3, np.cross(b - a, c - a) / 2
    distance = np.linalg.norm(x, axis=1)
    far = distance > 0
    x, f, distance = x[far], f[far], distance[far]
    angle, n = (x * f).sum(1) / distance**3, x / distance[:, None]
    reach = np.minimum(distance, r)
    second = np.einsum("k,ki,kj->ij", angle * reach**5 / 5, n, n)
    return (angle * reach**3 / 3).sum(), (angle * reach**4 / 4) @ n, second


@pytest.mark.parametrize("seed", range(12))
def test_against_quadrature(seed):
    """Tetrahedra, and solids with dents and horns, all of which the ball's component cuts."""
    rng = np.random.default_rng(seed)
    if seed % 2:
        vertices = rng.normal(size=(4, 3))
        faces = np.array([(0, 1, 2), (0, 2, 3), (0, 3, 1), (1, 3, 2)])
        a, b, c, d = vertices
        if np.dot(np.cross(b - a, c - a), d - a) > 0:
            faces = faces[:, ::-1]
        r = rng.uniform(0.6, 1.2) * np.linalg.norm(vertices[1:] - a, axis=1).min()
    else:
        ball = pyvista.Icosphere(radius=1, nsub=1)
        vertices = ball.points.astype(float) * rng.uniform(0.7, 1.2, (ball.n_points, 1))
        faces, r = ball.regular_faces, rng.uniform(0.4, 1.1)
    coarse, fine = (cones(vertices, faces, 0, r, depth) for depth in (5, 7) if depth)
    for a, b, c in zip(moments(vertices, faces, 0, r), coarse, fine):
        error = np.abs(c - b).max()
        np.testing.assert_allclose(a, c, atol=max(error, 1e-6))
        assert error < 0.01 * np.abs(c).max()


@pytest.mark.parametrize("seed", range(20))
def test_triangles_of_the_same_surface(seed):
    """And a turn of it."""
    rng = np.random.default_rng(seed)
    ball = pyvista.Icosphere(radius=1, nsub=1)
    vertices = ball.points.astype(float) * rng.uniform(0.5, 1.3, (ball.n_points, 1))
    faces, v, r = ball.regular_faces, rng.integers(ball.n_points), rng.uniform(0.2, 1.6)
    expected = moments(vertices, faces, v, r)
    assert np.isfinite(expected[0])
    assert_moments(moments(*refined(vertices, faces, rng, 60), v, r), expected, 1e-11)
    R = turn(seed)
    turned = expected[0], R @ expected[1], R @ expected[2] @ R.T
    assert_moments(moments(vertices @ R.T, faces, v, r), turned)


@pytest.mark.parametrize("nsub", [2, 3, 4])
def test_spheres(nsub):
    """Meshes inscribed in a sphere of radius 1 converge to it, O(h^2)."""
    ball, r = pyvista.Icosphere(radius=1, nsub=nsub), 0.8
    points = ball.points / np.linalg.norm(ball.points, axis=1)[:, None]
    volume, first, second = moments(points.astype(float), ball.regular_faces, 0, r)
    N, bound = points[0], 0.06 / 4 ** (nsub - 2)
    along = N @ second @ N
    tangential = 2 * np.pi * r**5 / 15 - np.pi * r**6 / 12 + np.pi * r**8 / 192
    for found, expected in (
        (volume, 2 * np.pi * r**3 / 3 - np.pi * r**4 / 4),
        (N @ first, -np.pi * r**4 / 4 + np.pi * r**6 / 24),
        (along, 2 * np.pi * r**5 / 15 - np.pi * r**8 / 96),
        (np.trace(second) - along, 2 * tangential),
    ):
        assert abs(found / expected - 1) < bound


def test_no_solid():
    """Within a boundary; a surface that the ball holds as a whole."""
    vertices, faces = refined(*box((0, 2), (0, 2), (0, 2)), np.random.default_rng(3), 60)
    for values in moments(vertices, faces, 0, 4.0):
        assert np.isnan(values).all()
    far = np.linalg.norm(vertices[faces], axis=2).min(1)
    for values in moments(vertices, np.delete(faces, far.argmax(), axis=0), 0, 3.4):
        assert np.isnan(values).all()
