"""Families of meshes: exact values at vertices, topology, shapes of triangles, seeds."""

import numpy as np
import pytest

from curvlib.catalogue import families, implicit
from curvlib.errors import InputError
from curvlib.estimation import estimate
from curvlib.implicit._exact import nearest

EVERY = [(name, surface) for name in families.names() for surface in families.module(name).SURFACES]
# Their vertices are near to the surface, not on it.
NEAR = {"marching_cubes", "voxels", "scan"}
CLOSED = {"ellipsoid": 2, "sphere": 2, "goursat": 2, "torus": 0, "genus_3": -4}
OPEN = {"open", "scan", "grid"}


def made(name, surface, n=24, seed=1):
    return families.module(name).make(surface, n, seed)


def edges(mesh):
    ends = np.sort(np.concatenate([mesh.faces[:, [k, (k + 1) % 3]] for k in range(3)]), 1)
    return np.unique(ends, axis=0, return_counts=True)


@pytest.mark.parametrize(("name", "surface"), EVERY)
def test_a_mesh_is_sound_and_has_exact_values_where_it_is_smooth(name, surface):
    mesh = made(name, surface)
    ends, uses = edges(mesh)
    assert uses.max() == 2
    assert set(np.unique(mesh.faces)) == set(range(len(mesh.vertices)))
    smooth = np.ones(len(mesh.vertices), bool) if mesh.smooth is None else mesh.smooth
    assert smooth.mean() > 0.5
    for field in (mesh.K, mesh.H, mesh.k1, mesh.k2):
        assert (np.isfinite(field) == smooth).all()
    np.testing.assert_allclose((mesh.k1 * mesh.k2)[smooth], mesh.K[smooth], atol=1e-9)
    np.testing.assert_allclose((mesh.k1 + mesh.k2)[smooth] / 2, mesh.H[smooth], atol=1e-9)
    if surface in CLOSED and name not in OPEN:
        assert len(mesh.vertices) - len(ends) + len(mesh.faces) == CLOSED[surface]
    if name not in NEAR | {"grid"} and surface in implicit.names():
        f, gradient, _ = implicit.module(surface).level(*mesh.vertices.T)
        assert np.abs(f / np.linalg.norm(gradient, axis=0)).max() < 1e-9


@pytest.mark.parametrize(("name", "surface"), EVERY)
def test_faces_are_turned_outward(name, surface):
    mesh = made(name, surface, 40)
    a, b, c = mesh.vertices[mesh.faces].swapaxes(0, 1)
    outward = (np.cross(b - a, c - a) * np.nan_to_num(mesh.normals[mesh.faces].mean(1))).sum(1)
    # A triangle as long as the radius of curvature may stand steep.
    assert (outward > 0).mean() > (0.97 if name.startswith("aniso") else 0.99)


@pytest.mark.parametrize(("name", "surface"), EVERY)
def test_a_seed_makes_the_same_mesh(name, surface):
    one, again, other = (made(name, surface, 16, seed) for seed in (3, 3, 4))
    assert one.vertices.tobytes() == again.vertices.tobytes()
    assert one.faces.tobytes() == again.faces.tobytes()
    drawn = name not in ("grid", "fan")
    assert (one.vertices.tobytes() != other.vertices.tobytes()) == drawn


CONVERGENT = [
    (name, surface)
    for name, surface in EVERY
    if name not in NEAR | {"fan", "grid"} and surface != "genus_3"
]


@pytest.mark.parametrize(("name", "surface"), CONVERGENT)
def test_exact_values_are_those_that_a_fit_converges_to(name, surface):
    """A wrong sign, factor or direction would leave an error that no refinement takes away."""
    errors = []
    for n in (48, 96) if name.startswith("aniso") else (24, 48):
        mesh = made(name, surface, n, 5)
        found = estimate((mesh.vertices, mesh.faces), "jet", degree=4, rings=2)
        part = ~mesh.boundary
        apart = part & (mesh.k1 - mesh.k2 > 0.3 * (np.abs(mesh.k1) + np.abs(mesh.k2)))
        across = np.linalg.norm(np.cross(found.d1, mesh.d1), axis=1)[apart]
        # Medians: pieces that meet, and triangles as long as the surface is wide, keep errors.
        errors.append(
            [np.nanmedian(np.abs(getattr(found, q) - getattr(mesh, q))[part]) for q in ("K", "H")]
            + [np.nanmedian(across) if np.isfinite(across).any() else 0]
        )
    coarse, fine = np.array(errors)
    assert ((fine < coarse / 2) | (fine < 1e-3)).all(), (coarse, fine)


def test_random_points_are_uniform_by_area():
    """On the torus the outer half has 1/2 + r / (pi R) of the area."""
    mesh = made("random", "torus", 100)
    outer = (np.hypot(*mesh.vertices[:, :2].T) > 2).mean()
    expected = 0.5 + 0.7 / (np.pi * 2)
    assert outer == pytest.approx(expected, abs=4 * 0.5 / 100)


def test_graded_meshes_span_a_ratio_of_thirty():
    for surface in ("torus", "ellipsoid"):
        mesh = made("graded", surface, 60)
        longest = np.array([np.linalg.norm(np.ptp(mesh.vertices[f], axis=0)) for f in mesh.faces])
        low, high = np.quantile(longest, (0.01, 0.99))
        assert 8 < high / low < 45


@pytest.mark.parametrize("surface", ["torus", "patch"])
def test_long_triangles_lie_along_and_across_the_principal_directions(surface):
    for name, turned in (("anisotropic", 0), ("anisotropic_turned", 45)):
        mesh = made(name, surface, 60)
        ends, _ = edges(mesh)
        along = mesh.vertices[ends[:, 1]] - mesh.vertices[ends[:, 0]]
        lengths = np.linalg.norm(along, axis=1)
        long = lengths > np.quantile(lengths, 0.7)
        assert np.quantile(lengths, 0.9) / np.quantile(lengths, 0.1) > 5
        if surface == "torus":
            x, y, _ = mesh.vertices[ends[long, 0]].T
            circle = np.stack((-y, x, 0 * x), -1) / np.hypot(x, y)[:, None]
            cosine = np.abs((along[long] * circle).sum(1)) / lengths[long]
        else:
            cosine = np.abs(along[long, 0]) / np.hypot(*along[long, :2].T)
        angle = np.degrees(np.arccos(np.minimum(cosine, 1)))
        assert np.median(angle) == pytest.approx(turned, abs=12)


def test_valences_decimation_fans_and_holes():
    def valences(mesh):
        return np.bincount(edges(mesh)[0].ravel())

    split = valences(made("valence", "torus", 40))
    assert (split == 3).mean() > 0.2
    assert split.max() > 9
    thin = made("decimated", "goursat", 30)
    assert len(thin.vertices) == pytest.approx(900, rel=0.05)
    assert np.sort(valences(made("fan", "cylinder", 64)))[-2:].tolist() == [64, 64]
    whole, cut = made("jittered", "torus"), made("open", "torus")
    assert len(cut.vertices) < len(whole.vertices)
    assert cut.boundary.sum() > 20


def test_the_rims_of_joints_are_no_places_of_curvature():
    lens = made("joints", "lens")
    rim = ~lens.smooth
    np.testing.assert_allclose(np.hypot(*lens.vertices[rim, :2].T), 0.8)
    centres = np.sign(lens.vertices[~rim, 2])[:, None] * [0, 0, -0.6]
    np.testing.assert_allclose(np.linalg.norm(lens.vertices[~rim] - centres, axis=1), 1)
    capsule = made("joints", "capsule")
    height = np.abs(capsule.vertices[:, 2])
    np.testing.assert_allclose(height[~capsule.smooth], 1)
    assert (capsule.K[height > 1] == 1).all()
    assert (capsule.K[height < 1] == 0).all()


def test_a_scan_sees_one_side_and_has_holes():
    mesh = made("scan", "torus", 60)
    rays = nearest("torus", mesh.vertices)
    away = np.linalg.norm(rays - mesh.vertices, axis=1)
    assert 0 < np.median(away) < 0.05 * mesh.mean_edge
    assert mesh.boundary.sum() > 60
    whole = families.module("scan")
    depths = (mesh.vertices @ whole._turn().T)[:, 2]
    steps = np.diff(np.unique(depths.round(9)))
    np.testing.assert_allclose(steps / steps.min(), np.round(steps / steps.min()), atol=1e-4)
    # Nothing of the surface is in front of a sample.
    above = np.column_stack((np.zeros((2, len(depths))).T, np.ones(len(depths)))) @ whole._turn()
    level = implicit.module("torus").level
    for height in (0.3, 0.6, 1.2, 2.4):
        assert (level(*(mesh.vertices + height * above).T)[0] > -0.05).mean() > 0.99


def test_an_unknown_family_is_told_with_the_nearest():
    with pytest.raises(InputError, match="jittered"):
        families.module("jitterd")
