"""One-rings: which there are, their angles, and the ones that determine nothing."""

import mpmath
import numpy as np
import pytest

import curvlib
from curvlib.catalogue import estimators as catalogue
from curvlib.claims.cell import NINE as PAPER
from curvlib.kit.ring import alpha, beta, one_ring, total_angle
from curvlib.signatures import readings


@pytest.mark.parametrize("n", [3, 63, 64, 200, 10000])
def test_a_high_valence(n):
    """A pyramid whose faces come in any order: the ring of its apex, and values there."""
    rng = np.random.default_rng(n)
    around = 2 * np.pi * np.arange(n) / n
    rim = np.column_stack((np.cos(around), np.sin(around), 0 * around))
    vertices = np.vstack((rim, [[0, 0, 0.1]]))
    k = np.arange(n)
    faces = rng.permutation(np.column_stack((k, (k + 1) % n, np.full(n, n))))
    mesh = curvlib.Mesh(vertices, faces)
    ((apex, ring),) = mesh.rings
    np.testing.assert_array_equal(apex, [n])
    np.testing.assert_array_equal((ring[:, 0] - ring[0, 0]) % n, k)
    found = curvlib.estimate(mesh, "watanabe_b")
    assert found.H[n] == pytest.approx(2 * 0.1 / 1.01)
    torn = np.delete(faces, 1, axis=0)
    assert curvlib.Mesh(vertices, torn).rings == []
    torn[0] = torn[1]
    assert curvlib.Mesh(vertices, torn).rings == []


@pytest.mark.parametrize("name", PAPER)
def test_an_undefined_ring_leaves_the_others_alone(name):
    """Rings of one batch, of which some have no normal or two vertices in one place."""
    rng = np.random.default_rng(4)
    around = 2 * np.pi * (np.arange(7)[:, None] + rng.uniform(-0.3, 0.3, (7, 50))) / 7
    e = np.array([np.cos(around), np.sin(around), rng.uniform(-0.3, 0.1, (7, 50))])
    up = np.tile([[0.0], [0], [1]], 50)
    function, options = catalogue.module(name).estimate, {}
    if "normal" in readings(name):
        options["normal"] = "exact"
    expected = np.array(function(one_ring(e, up), **options))
    e[:, 3, 0], up[:, 10], e[:, :, 20] = 0, np.nan, np.nan
    with np.errstate(divide="ignore", invalid="ignore"):
        found = np.array(function(one_ring(e, up), **options))
    others = ~np.isin(np.arange(50), (0, 10, 20))
    np.testing.assert_allclose(found[:, others], expected[:, others], rtol=1e-13)


@pytest.mark.parametrize("n", [3, 4, 5, 7, 40, 1000])
def test_the_total_angle_is_the_sum_of_the_angles(n):
    """Of flat, pointed and crumpled rings, and of quarter turns."""
    rng = np.random.default_rng(n)
    crumpled = rng.normal(size=(3, n, 500))
    pointed = crumpled + np.array([0, 0, 5])[:, None, None]
    around = 2 * np.pi * np.arange(n) / n
    flat = np.array([np.cos(around), np.sin(around), 0 * around])[..., None] * [1, -1e3, 1e-3]
    quarters = np.array([(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0)]).take(np.arange(n) % 4, 0)
    for e in (crumpled, pointed, flat, quarters.T[..., None]):
        with np.errstate(divide="ignore"):
            ring = one_ring(np.ascontiguousarray(e), np.empty((3, 0)))
            np.testing.assert_allclose(
                total_angle(ring), alpha(ring).sum(0), rtol=1e-12, atol=1e-12
            )


def test_dihedral_angles_between_slivers():
    """Against 50 digits: neighbours of a vertex nearly in one line with it."""
    rng = np.random.default_rng(0)
    line = np.array([[700, 0, 0], [400, 0, 0], [100, 0, 0]])
    rest = np.array([[40, 80, -30], [-60, 70, 20], [-90, -50, 10], [30, -95, -25]])
    for noise in 10.0 ** np.arange(-6, 0):
        q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        q *= np.sign(np.linalg.det(q))
        e = (np.vstack((line + noise * rng.normal(size=(3, 3)), rest)) @ q.T).T[..., None].copy()
        found = beta(one_ring(e, np.empty((3, 0))))[:, 0]
        with mpmath.workdps(50):
            exact = [[mpmath.mpf(x) for x in e[:, i, 0]] for i in range(7)]
            expected = [_dihedral(exact[i - 1], exact[i], exact[(i + 1) % 7]) for i in range(7)]
        np.testing.assert_allclose(found, expected, atol=1e-12 * 700 / noise)


def _dihedral(before, edge, after):
    """Angle about `edge` from the plane with `before` to that with `after`: convex positive."""

    def cross(a, b):
        return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]

    m, n = cross(before, edge), cross(edge, after)
    length = mpmath.sqrt(mpmath.fdot(edge, edge))
    return float(mpmath.atan2(-mpmath.fdot(edge, cross(m, n)) / length, mpmath.fdot(m, n)))


@pytest.mark.parametrize("thickness", [0.0, 1e-3])
def test_sheets(thickness):
    """A plate: without thickness its rim has no H, and no normal where its sides cancel; as thin
    as a thousandth, H is positive there, however it stands, and negative inside out."""
    rng = np.random.default_rng(0)
    n = 5
    x, y = np.meshgrid(np.arange(n + 1.0), np.arange(n + 1.0), indexing="ij")
    top = np.column_stack((x.ravel(), y.ravel(), np.zeros(x.size)))
    at = np.arange(x.size).reshape(n + 1, n + 1)
    a, b, c, d = at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]
    faces = np.concatenate([np.stack(t, -1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])
    inside = np.zeros(x.shape, bool)
    inside[1:-1, 1:-1] = True
    inside = inside.ravel()
    below = at.ravel().copy()
    below[inside] = len(top) + np.arange(inside.sum())
    vertices = np.vstack((top, top[inside] - [0, 0, thickness]))
    faces = np.vstack((faces, below[faces][:, ::-1]))
    rim = np.flatnonzero(~inside)
    # Elsewhere, next to the corners, four faces share an edge.
    thick = curvlib.Mesh(vertices, faces).closed[rim]
    for sign, turned in ((1, faces), (-1, faces[:, ::-1])):
        for _ in range(10):
            q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
            q *= np.sign(np.linalg.det(q))
            r = curvlib.estimate((vertices @ q.T, turned), PAPER)
            assert np.isfinite(r["gauss_bonnet"].K[rim[thick]]).all()
            for name in PAPER:
                H = sign * r[name].H[rim]
                if thickness:
                    assert (H[thick] > 0).all()
                    assert np.isnan(H[~thick]).all()
                else:
                    assert np.isnan(H).all()


@pytest.mark.parametrize("name", PAPER)
def test_written_rings_stay_with_who_wrote(tmp_path, name, ellipsoid):
    """A file from elsewhere that overwrites its ring, compiled or not."""
    for number, decorator in enumerate(("", "@compiled\n")):
        path = tmp_path / f"rude{number}.py"
        path.write_text(
            "from curvlib.kit.compiled import compiled\n\n\n"
            f"{decorator}def estimate(ring):\n    ring.e[:] = 0\n    ring.areas[:] = 0\n"
            "    return ring.areas[0], None\n"
        )
        together = curvlib.estimate(ellipsoid, [str(path), name])
        for values, expected in zip(together[name], curvlib.estimate(ellipsoid, name)):
            np.testing.assert_array_equal(values, expected)
