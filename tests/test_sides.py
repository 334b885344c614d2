"""Estimates where a surface has creases: cut along them, one-sided or NaN."""

import numpy as np
import pytest
from sharp import block, can, rounded

import curvlib

NAMES = ("K", "H", "k1", "k2", "d1", "d2")


def rows_from(mesh, on):
    """(V,) how many edges each vertex is away from those `on` (V,) bool."""
    away, edges = np.where(on, 0, 99), np.vstack([mesh.faces[:, [k, k - 1]] for k in range(3)])
    for _ in range(20):
        np.minimum.at(away, edges[:, 0], away[edges[:, 1]] + 1)
    return away


@pytest.mark.parametrize("name", [None, "compact_hermite", "jet", "quadric"])
def test_faces_of_a_block_are_flat_up_to_their_edges(name):
    mesh = block(12)
    r = curvlib.estimate(mesh, name, creases="one-sided")
    assert r.crease.sum() == 12 * 12 - 4
    for k in (r.K, r.H, r.k1, r.k2):
        assert np.abs(k).max() < 1e-12


def test_a_cylinder_with_caps():
    """On the rim it has the curvature of the wall, which is larger; elsewhere that of its side."""
    mesh = can(48, 24)
    r = curvlib.estimate(mesh)
    distance = np.linalg.norm(mesh.vertices[:, :2], axis=1)
    rim = (np.abs(mesh.vertices[:, 2]) == 1) & (distance > 0.999)
    np.testing.assert_array_equal(r.crease, rim)
    wall, far = distance > 0.999, rows_from(mesh, rim) >= 4
    assert np.abs(r.H[~wall]).max() < 1e-12
    assert np.abs(r.K[~wall]).max() < 1e-12
    assert np.abs(r.H - 0.5)[rim].max() < 0.1
    assert np.abs(r.H - 0.5)[wall & far].max() < 1e-4
    assert np.abs(r.K)[wall & far].max() < 1e-4
    blunt = curvlib.estimate(mesh, creases="ignore")
    assert blunt.crease is None
    assert np.abs(blunt.H - 0.5)[wall & far].max() > 1e-2
    none = curvlib.estimate(mesh, creases="nan")
    assert np.isnan(none.H[rim]).all()
    assert none.undefined["crease"] == rim.sum()
    for name in NAMES:
        np.testing.assert_array_equal(getattr(none, name)[~rim], getattr(r, name)[~rim])
    np.testing.assert_array_equal(none.choice.index, r.choice.index)


def test_rings_that_a_crease_opens_are_counted_as_such():
    mesh = block(10)
    for mode in ("nan", "one-sided"):
        r = curvlib.estimate(mesh, "gauss_bonnet", creases=mode)
        assert r.undefined == {"crease": 116}
        assert np.abs(r.K[~r.crease]).max() < 1e-12
    assert curvlib.estimate(mesh, "gauss_bonnet").crease is None


def test_a_resolved_rounding_is_no_crease():
    mesh = rounded(24, 0.5)
    r = curvlib.estimate(mesh)
    assert not r.crease.any()
    expected = curvlib.estimate(mesh, creases="ignore")
    for name in NAMES:
        np.testing.assert_array_equal(getattr(r, name), getattr(expected, name))


def test_joints_of_the_teapot_are_smooth_to_first_order():
    for name in ("teapot_body", "teapot_spout"):
        assert not curvlib.estimate(curvlib.tessellate(curvlib.surface(name), 24)).crease.any()


def test_where_a_teapots_body_meets_a_lid():
    """A flat lid on the rim: the wall has the values that it has alone."""
    wall = curvlib.tessellate(curvlib.surface("teapot_body_wall"), 32)
    rim = np.flatnonzero(wall.boundary & (wall.vertices[:, 1] > 2))
    rim = rim[np.argsort(np.arctan2(wall.vertices[rim, 0], wall.vertices[rim, 2]))]
    rings, count = 8, len(wall.vertices)
    inner = [wall.vertices[rim] * (k / rings, 1, k / rings) for k in range(rings - 1, 0, -1)]
    number = np.vstack((rim, count + np.arange((rings - 1) * len(rim)).reshape(rings - 1, -1)))
    top = count + (rings - 1) * len(rim)
    a, b = number[:-1], np.roll(number, -1, axis=1)[:-1]
    c, d = np.roll(number, -1, axis=1)[1:], number[1:]
    faces = np.concatenate([np.stack(t, -1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])
    last = np.column_stack((d[-1], c[-1], np.full(len(rim), top)))
    middle = wall.vertices[rim].mean(0) * (0, 1, 0)
    vertices = np.vstack((wall.vertices, *inner, middle))
    mesh = curvlib.Mesh(vertices, np.vstack((wall.faces, faces, last)))
    found = curvlib.estimate(mesh, ["adaptive_fit", "jet"], creases="one-sided")
    for r in found.values():
        np.testing.assert_array_equal(np.flatnonzero(r.crease), np.sort(rim))
        assert np.abs(r.H[count:]).max() < 1e-9
    own = ~found["jet"].crease[:count]
    for name in NAMES:
        of_wall = getattr(curvlib.estimate(wall, "jet"), name)
        np.testing.assert_array_equal(getattr(found["jet"], name)[:count][own], of_wall[own])


def test_several_estimators_share_the_cut():
    mesh = block(10)
    found = curvlib.estimate(mesh, ["jet", "adaptive_fit", "gauss_bonnet"])
    assert found["jet"].crease is None
    assert found["adaptive_fit"].crease.sum() == 116
    for name, r in found.items():
        np.testing.assert_array_equal(r.K, curvlib.estimate(mesh, name).K)


def test_soups_have_values_at_all_of_their_points():
    mesh = block(10)
    soup = mesh.vertices[mesh.faces].reshape(-1, 3), np.arange(mesh.faces.size).reshape(-1, 3)
    expected = curvlib.estimate(mesh)
    with pytest.warns(curvlib.MeshWarning, match="joined"):
        r = curvlib.estimate(soup)
    np.testing.assert_array_equal(r.crease, expected.crease[mesh.faces.reshape(-1)])
    np.testing.assert_allclose(r.H, 0, atol=1e-12)


def test_triangles_have_values_of_their_side():
    mesh = block(12)
    r = curvlib.estimate(mesh, per="face", creases="nan")
    assert len(r.crease) == len(mesh.faces)
    corners = mesh.vertices[mesh.faces]
    middles = (corners + np.roll(corners, -1, axis=1)) / 2
    on = (np.abs(np.abs(middles) - 1) < 1e-9).sum(2) > 1
    np.testing.assert_array_equal(r.crease, on.any(1))
    assert np.abs(r.H).max() < 1e-12


def test_threads_and_callers_arrays():
    mesh = can(30, 14)
    vertices, faces = mesh.vertices.copy(), mesh.faces.copy()
    one, two = (curvlib.estimate((vertices, faces), threads=t, creases="nan") for t in (1, 2))
    for name in (*NAMES, "crease"):
        np.testing.assert_array_equal(getattr(one, name), getattr(two, name))
    np.testing.assert_array_equal(vertices, mesh.vertices)
    np.testing.assert_array_equal(faces, mesh.faces)


def test_the_flag_is_a_column():
    r = curvlib.estimate(block(8))
    assert r.to_polydata()["crease"].sum() == r.to_dataframe().crease.sum() == 92
    assert "crease" not in curvlib.estimate(block(8), "jet").to_dataframe()
    assert "<th>crease" not in r._repr_html_()


def test_unknown_modes():
    with pytest.raises(curvlib.InputError, match="one-sided"):
        curvlib.estimate(block(4), creases="onesided")
