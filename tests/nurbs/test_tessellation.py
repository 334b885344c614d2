"""Meshes of surfaces: counts, manifoldness, topology, diagonals, exact values."""

import numpy as np
import pytest

import curvlib
from curvlib.nurbs.tessellation import DIAGONALS, _Grid

SURFACES = curvlib.surfaces()


def edges(faces):
    return np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])


def poles(surface):
    return sum(surface.has_pole(axis, end) for axis in (0, 1) for end in (0, -1))


@pytest.mark.parametrize("diagonal", DIAGONALS)
@pytest.mark.parametrize("n", [3, 8, 13])
@pytest.mark.parametrize("name", SURFACES)
def test_manifold_with_the_surface_s_topology(name, n, diagonal):
    s = curvlib.surface(name)
    m = curvlib.tessellate(s, n, diagonal)
    assert len(m.faces) == 2 * n * n - n * poles(s)
    directed, count = np.unique(edges(m.faces), axis=0, return_counts=True)
    assert (count == 1).all(), "an edge is run through twice in one direction"
    undirected, sides = np.unique(np.sort(directed, axis=1), axis=0, return_counts=True)
    assert sides.max() <= 2
    assert set(np.unique(m.faces)) == set(range(len(m.vertices)))
    # A tube has 0, each pole closes an end.
    assert len(m.vertices) - len(undirected) + len(m.faces) == poles(s)
    on_boundary = np.zeros(len(m.vertices), bool)
    on_boundary[undirected[sides == 1]] = True
    np.testing.assert_array_equal(m.boundary, on_boundary)
    ring_vertices = np.concatenate([v for v, _ in m.rings])
    np.testing.assert_array_equal(np.sort(ring_vertices), np.flatnonzero(~on_boundary))


def test_published_triangle_counts_of_the_spout():
    s = curvlib.surface("teapot_spout")
    counts = [len(curvlib.tessellate(s, n).faces) for n in (8, 12, 16, 24, 32, 50)]
    assert counts == [128, 288, 512, 1152, 2048, 5000]


@pytest.mark.parametrize("name", SURFACES)
def test_vertices_carry_the_exact_values_of_their_parameters(name):
    s = curvlib.surface(name)
    m = curvlib.tessellate(s, 12)
    exact = s.curvature(*m.uv.T)
    np.testing.assert_array_equal(m.vertices, s.point(*m.uv.T))
    for field in ("K", "H", "k1", "k2", "smooth"):
        np.testing.assert_array_equal(getattr(m, field), getattr(exact, field))
    np.testing.assert_array_equal(m.normals, exact.normal)


def test_rows_that_are_not_smooth():
    """u = 1 is a grid row of the spout for every even n; the apex of the cone is one vertex."""
    for n in (8, 50):
        m = curvlib.tessellate(curvlib.surface("teapot_spout"), n)
        np.testing.assert_array_equal(~m.smooth, m.uv[:, 0] == 1)
    m = curvlib.tessellate(curvlib.surface("cone_apex"), 8)
    assert (~m.smooth).sum() == 1
    np.testing.assert_allclose(m.vertices[~m.smooth], [[0, 0, 2.5]])


def test_diagonals():
    s = curvlib.surface("cylinder")

    def valences(diagonal, **options):
        m = curvlib.tessellate(s, 12, diagonal, **options)
        return {len(neighbours) for _, neighbours in m.rings}

    assert valences("same") == {6}
    assert valences("alternate") == {4, 8}
    assert len(valences("random")) > 3
    one, same, two = (curvlib.tessellate(s, 12, "random", seed=k).faces for k in (1, 1, 2))
    np.testing.assert_array_equal(one, same)
    assert (one != two).any()


def test_shortest_diagonal_is_the_shortest():
    s = curvlib.surface("teapot_spout")
    length = {}
    for diagonal in DIAGONALS:
        m = curvlib.tessellate(s, 16, diagonal)
        e = edges(m.faces)
        length[diagonal] = np.linalg.norm(m.vertices[e[:, 0]] - m.vertices[e[:, 1]], axis=1).sum()
    assert length["shortest"] < min(length[d] for d in DIAGONALS if d != "shortest")


@pytest.mark.parametrize("n", [2, 0, -3, 8.0, "8", True, None])
def test_bad_resolution(n):
    with pytest.raises(curvlib.InputError, match="is not an integer of at least 3"):
        curvlib.tessellate(curvlib.surface("sphere"), n)


def test_no_surface():
    for surface in ("sphere", None, curvlib.surface("sphere").model):
        with pytest.raises(curvlib.InputError, match=r"a curvlib\.Surface is needed, not "):
            curvlib.tessellate(surface, 8)


def test_more_cells_than_a_mesh_counts():
    with pytest.raises(curvlib.InputError, match="resolution 18919 is more than 18918"):
        curvlib.tessellate(curvlib.surface("sphere"), 18919)


def test_bad_diagonal():
    with pytest.raises(curvlib.InputError, match="'shortst'; did you mean 'shortest'"):
        curvlib.tessellate(curvlib.surface("sphere"), 8, "shortst")


@pytest.mark.parametrize("cut", ["random-", "random-²", "random--1", "random-1.5", "same-1", "x"])
def test_bad_cuts(cut):
    with pytest.raises(curvlib.InputError, match=r"a seed is a number|unknown diagonal"):
        curvlib.tessellate(curvlib.surface("sphere"), 8, cut)


@pytest.mark.parametrize("seed", [-1, 1.5, "1"])
def test_bad_seeds(seed):
    with pytest.raises(curvlib.InputError, match=r"seed .* is not an integer of at least 0"):
        curvlib.tessellate(curvlib.surface("sphere"), 8, "random", seed=seed)


@pytest.mark.parametrize("diagonal", DIAGONALS)
def test_cuts_leave_the_grid_as_it_is(diagonal):
    grid = _Grid(curvlib.surface("ellipsoid"), 8)
    before = grid.at.copy(), grid.index.copy()
    at, _ = DIAGONALS[diagonal](grid, np.random.default_rng(0))
    np.testing.assert_array_equal(grid.at, before[0])
    np.testing.assert_array_equal(grid.index, before[1])
    assert (at is grid.at) == (diagonal != "jittered")


@pytest.mark.parametrize("n", [10, 20, 30, 70])
def test_rows_of_the_grid_meet_knots(build, n):
    """Neither 0.3 + (0.7 - 0.3) k / n nor its last value is a knot by itself."""
    knots = [0.3] * 3 + [0.34, 0.34, 0.42, 0.42, 0.58, 0.58] + [0.7] * 3
    x, y = np.meshgrid(np.arange(9.0), np.arange(9.0), indexing="ij")
    s = build((2, 2), (knots, knots), np.stack((x, y, np.cos(x) * y), -1))
    uv = curvlib.tessellate(s, n).uv
    for breaks, t in zip(s.breaks, uv.T):
        assert np.isin(breaks, t).all()
