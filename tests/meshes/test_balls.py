"""Balls of triangles and geodesic disks, against brute force and closed forms."""

import numpy as np
import pytest
import scipy.sparse
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import Delaunay

import curvlib
from curvlib.kit.options import Geodesic, Length
from curvlib.meshes.facets import facets
from curvlib.meshes.torus import torus


def plane(n, seed):
    """Delaunay triangles of random points of a square, its corners and sides among them, in a
    plane that is not that of two axes."""
    rng = np.random.default_rng(seed)
    side = np.linspace(0, 1, 12)
    rim = [(x, y) for x in side for y in side if x in (0, 1) or y in (0, 1)]
    points = np.vstack((rim, rng.uniform(0.02, 0.98, (n, 2))))
    faces = Delaunay(points).simplices
    a, b, c = points[faces].transpose(1, 0, 2)
    turned = np.cross(b - a, c - a) < 0
    faces[turned] = faces[turned, ::-1]
    return points, points @ [[0.6, 0.0, 0.8], [0.0, 1.0, 0.0]], faces


def contents(ball, radius: Length = 0.25):
    """The area within the ball, and the number of triangles."""
    total = 0.0
    for t in range(len(ball.inside)):
        i, j, k = ball.triangles[0, t], ball.triangles[1, t], ball.triangles[2, t]
        total += ball.inside[t] * np.linalg.norm(
            np.cross(ball.points[:, j] - ball.points[:, i], ball.points[:, k] - ball.points[:, i])
        )
    return total / 2, float(len(ball.inside))


@pytest.mark.parametrize(("count", "radius"), [(20, 0.2), (400, 0.2), (400, 0.03), (20, 0.01)])
def test_a_disc_of_a_plane_is_filled(count, radius):
    """Radii below and above the length of edges, all inside of the square."""
    points, vertices, faces = plane(count, seed=count)
    found = curvlib.estimate((vertices, faces), contents, radius=radius).K
    inner = (np.abs(points - 0.5).max(1) < 0.5 - radius) & np.isfinite(found)
    assert inner.sum() > count / 4
    np.testing.assert_allclose(found[inner], np.pi * radius**2, rtol=1e-9)
    middle = (points[:, 0] == 0) & (np.abs(points[:, 1] - 0.5) < 0.5 - radius)
    np.testing.assert_allclose(found[middle], np.pi * radius**2 / 2, rtol=1e-9)


def test_a_ball_holds_the_component_of_its_vertex_alone():
    """Two parallel sheets, closer than the radius, are apart; joined at their rim, they are not
    connected within the ball about a vertex in the middle."""
    _, vertices, faces = plane(300, seed=3)
    count = len(vertices)
    normal = np.cross([0.6, 0, 0.8], [0, 1.0, 0])
    both = np.vstack((vertices, vertices + 0.05 * normal))
    alone = curvlib.estimate((vertices, faces), contents).K
    sheets = np.vstack((faces, faces[:, ::-1] + count))
    np.testing.assert_array_equal(curvlib.estimate((both, sheets), contents).K[:count], alone)
    mesh = curvlib.Mesh(vertices, faces)
    edges = {(a, b) for f in faces for a, b in zip(f, np.roll(f, -1))}
    rim = [(a, b) for a, b in edges if (b, a) not in edges]
    wall = [(b, a, a + count) for a, b in rim] + [(b, a + count, b + count) for a, b in rim]
    closed = curvlib.Mesh(both, np.vstack((sheets, wall)))
    assert closed.closed.all()
    found = curvlib.estimate(closed, contents).K[:count]
    far = ~mesh.boundary & np.isclose(alone, np.pi / 16, rtol=1e-9)
    assert far.sum() > 20
    np.testing.assert_allclose(found[far], alone[far], rtol=1e-12)
    assert (found[mesh.boundary] > alone[mesh.boundary]).all()


def brute(vertices, faces, v, radius):
    """The triangles connected to a vertex through edges that meet the ball, by repeated union."""

    def distance(a, b):
        d = vertices[b] - vertices[a]
        t = np.clip((vertices[v] - vertices[a]) @ d / (d @ d), 0, 1)
        return np.linalg.norm(vertices[a] + t * d - vertices[v])

    across = {}
    for t, f in enumerate(faces):
        for a, b in zip(f, np.roll(f, -1)):
            across[a, b] = t
    found = {t for t, f in enumerate(faces) if v in f}
    new = set(found)
    while new:
        t = new.pop()
        for a, b in zip(faces[t], np.roll(faces[t], -1)):
            other = across.get((b, a))
            if other is not None and other not in found and distance(a, b) < radius:
                found.add(other)
                new.add(other)
    return found


@pytest.mark.parametrize("radius", [0.1, 0.4, 0.9])
def test_the_triangles_are_those_of_a_brute_force_search(radius):
    mesh = curvlib.tessellate(curvlib.surface("teapot_spout"), 8, "random", seed=2)
    found = curvlib.estimate(mesh, contents, radius=radius).H
    for v in range(0, len(found), 5):
        if np.isfinite(found[v]):
            assert found[v] == len(brute(mesh.vertices, mesh.faces, v, radius))


def check(ball, radius: Length = None):
    """1 where all that a Ball promises holds; the number of triangles at the vertex."""
    n = 0
    while n < ball.triangles.shape[1] and ball.triangles[0, n] == 0:
        n += 1
    right = not (ball.triangles[:, n:] == 0).any()
    for t in range(n):
        following = ball.triangles[1, (t + 1) % n]
        last = t == n - 1 and not ball.closed
        right &= last or ball.triangles[2, t] == following
        right &= last or ball.across[2, t] == (t + 1) % n
    for t in range(ball.triangles.shape[1]):
        for k in range(3):
            other = ball.across[k, t]
            if other >= 0:
                a, b = ball.triangles[k, t], ball.triangles[(k + 1) % 3, t]
                shared = False
                for j in range(3):
                    x, y = ball.triangles[j, other], ball.triangles[(j + 1) % 3, other]
                    shared |= x == b and y == a and ball.across[j, other] == t
                right &= shared
    return 1.0 if right else 0.0, float(n)


@pytest.mark.parametrize("radius", [None, 0.05, 0.4])
def test_order_and_adjacency_in_a_ball(radius):
    mesh = curvlib.tessellate(curvlib.surface("revolution"), 10, "random", seed=2)
    found = curvlib.estimate(mesh, check, radius=radius)
    assert (found.K == 1).all()
    np.testing.assert_array_equal(found.H, np.bincount(mesh.faces.ravel()))


def test_fields_are_gathered_in_the_order_of_points():
    """The position of each vertex as a field, two fields deep."""
    mesh = curvlib.tessellate(curvlib.surface("ellipsoid"), 8)
    found = curvlib.estimate(mesh, from_fields, radius=0.4)
    np.testing.assert_allclose(found.K, 0, atol=1e-28)
    assert (found.H > 3).all()


def own(disk):
    return disk.exact_normal


def doubled(ball, own):
    return 2 * own[0, 0], 2 * own[1, 0], 2 * own[2, 0]


def from_fields(ball, doubled, radius: Length = 0.3):
    """Twice the normals of the unit ellipsoid's points determine the points."""
    off = 0.0
    for i in range(ball.points.shape[1]):
        off = max(off, abs(np.sqrt((doubled[:, i] ** 2).sum()) - 2))
    return off * off, float(ball.points.shape[1])


def reached(disk, radius: Geodesic = 0.5):
    """The largest distance, and the number of neighbours: NaN where they are not in order."""
    ordered = True
    for k in range(1, disk.count):
        ordered &= disk.distances[k - 1] <= disk.distances[k]
    for k in range(disk.count, len(disk.distances)):
        ordered &= disk.distances[k] == 0
    return disk.distances[disk.count - 1] if ordered else np.nan, float(disk.count)


PER = ("vertex", "face")


def graph(points, pairs):
    a, b = np.transpose(pairs)
    lengths = np.linalg.norm(points[a] - points[b], axis=1)
    return scipy.sparse.coo_matrix((lengths, (a, b)), (len(points),) * 2).tocsr()


@pytest.mark.parametrize("per", PER)
@pytest.mark.parametrize("radius", [0.3, 1.0])
def test_geodesic_disks_are_those_of_scipy(per, radius):
    vertices, faces = torus(24, "irregular")
    if per == "vertex":
        points = vertices
        pairs = [(a, b) for f in faces for a in f for b in f if a != b]
    else:
        points = vertices[faces].mean(1)
        at = [[] for _ in vertices]
        for t, f in enumerate(faces):
            for v in f:
                at[v].append(t)
        pairs = [(s, t) for around in at for s in around for t in around if s != t]
    edges = graph(points, sorted(set(pairs)))
    found = curvlib.estimate((vertices, faces), reached, radius=radius, per=per)
    distances = dijkstra(edges, directed=False, limit=radius)
    within = np.isfinite(distances)
    np.testing.assert_array_equal(found.H, within.sum(1) - 1)
    expected = np.where(within, distances, 0).max(1)
    np.testing.assert_allclose(found.K[expected > 0], expected[expected > 0], rtol=1e-12)


def test_neighbours_of_triangles_on_a_broken_mesh():
    """A third face on an edge, and a face that names a vertex twice: no way through them."""
    vertices, faces = torus(8, "regular")
    fin = np.vstack((faces, [[faces[0, 0], faces[0, 1], len(vertices)], [5, 5, 6]]))
    mesh = curvlib.Mesh(np.vstack((vertices, [[9, 9, 9]])), fin)
    _, _, _, offsets, neighbours, stars = facets(mesh)
    assert stars[-1] == 0
    assert offsets[-1] == offsets[-2] == offsets[-3]
    assert not np.isin(neighbours, [len(faces), len(faces) + 1]).any()
    rows = np.split(neighbours, offsets[1:-1])
    assert all((np.diff(row) > 0).all() for row in rows)
    assert all(t in rows[s] for t, row in enumerate(rows) for s in row)


def test_triangles_at_a_vertex_of_very_many():
    """20,000 at the apex of a cone are neighbours around its rim alone, not each of each."""
    n = 20000
    angle, i = np.arange(n) * 2 * np.pi / n, np.arange(n)
    rim = np.column_stack((np.cos(angle), np.sin(angle), 0 * angle))
    faces = np.column_stack((0 * i, 1 + i, 1 + (i + 1) % n))
    _, _, _, offsets, neighbours, _ = facets(curvlib.Mesh(np.vstack(([[0, 0, 1]], rim)), faces))
    assert (np.diff(offsets) == 2).all()
    np.testing.assert_array_equal(neighbours.reshape(n, 2)[1:-1, 0], i[:-2])
    np.testing.assert_array_equal(neighbours.reshape(n, 2)[1:-1, 1], i[2:])


def test_per_face_where_there_is_none():
    with pytest.raises(curvlib.InputError, match="'quadric' has values at vertices alone"):
        curvlib.estimate(torus(8, "regular"), "quadric", per="face")
    with pytest.raises(curvlib.InputError, match="'faces'"):
        curvlib.estimate(torus(8, "regular"), reached, per="faces")
