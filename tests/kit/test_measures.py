"""Measures of triangles and edges: against the values of the authors' program, closed forms."""

from pathlib import Path

import numpy as np
import pytest

from curvlib.kit.compiled import compiled
from curvlib.kit.measures import corrected_measures, dihedral
from curvlib.kit.vectors import at

PEERS = np.load(Path(__file__).with_name("corrected_measures.npz"))


@compiled
def of_triangles(corners, normals, out):
    """Measures (m, 12) of triangles, whose corners and normals are (3, 3, m): component, corner."""
    for k in range(len(out)):
        mu0, mu1, mu2, muXY = corrected_measures(
            at(corners, 0, k),
            at(corners, 1, k),
            at(corners, 2, k),
            at(normals, 0, k),
            at(normals, 1, k),
            at(normals, 2, k),
        )
        out[k, 0], out[k, 1], out[k, 2] = mu0, mu1, mu2
        for i in range(3):
            out[k, 3 + 3 * i], out[k, 4 + 3 * i], out[k, 5 + 3 * i] = muXY[i]


def measures(corners, normals):
    """(m, 12) of (m, 3, 3)."""
    out = np.empty((len(corners), 12))
    of_triangles(*(np.ascontiguousarray(x.T) for x in (corners, normals)), out)
    return out


def test_corrected_measures_against_the_authors_formulas():
    """mu0, mu1, mu2 and muXY row by row, by the authors' header, of triangles of two meshes with
    exact normals and with those by area."""
    found, expected = measures(PEERS["corners"], PEERS["normals"]), PEERS["measures"]
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-15)
    assert np.abs(expected).max() > 0.1


def test_corrected_measures_of_a_sphere():
    """With exact normals H = 1 / r and K = 1 / r^2, whatever the triangle."""
    rng = np.random.default_rng(0)
    normals = rng.standard_normal((60, 3))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    normals = normals.reshape(20, 3, 3)
    mu0, mu1, mu2, *muXY = measures(3 * normals + (1, 2, 3), normals).T
    np.testing.assert_allclose(mu1 / (2 * mu0), 1 / 3, rtol=1e-10)
    np.testing.assert_allclose(mu2 / mu0, 1 / 9, rtol=1e-10)
    np.testing.assert_allclose(muXY[0] + muXY[4] + muXY[8], -mu1, atol=1e-14)


def test_corrected_measures_of_constant_normals():
    """No curvature, and the area of the projection."""
    corners = np.random.default_rng(1).standard_normal((3, 3))
    n = (0.0, 0.6, 0.8)
    mu0, mu1, mu2, *muXY = measures(corners[None], np.array([[n, n, n]]))[0]
    facet = np.cross(corners[1] - corners[0], corners[2] - corners[0]) / 2
    assert mu0 == pytest.approx(facet @ n, rel=1e-13)
    assert (mu1, mu2) == pytest.approx((0, 0), abs=1e-15)
    assert np.abs(muXY).max() < 1e-15


@pytest.mark.parametrize("angle", [-3.1, -1, -1e-9, 0, 1e-9, 0.5, np.pi / 2, 3.1])
def test_dihedral_angles(angle):
    """Convex where each normal leans towards its own side; edges and normals of any length."""
    left = 2 * np.sin(angle / 2), 0.0, 2 * np.cos(angle / 2)
    right = -3 * np.sin(angle / 2), 0.0, 3 * np.cos(angle / 2)
    assert dihedral((0.0, -5.0, 0.0), left, right) == pytest.approx(angle, abs=1e-15)
    assert dihedral((0.0, 5.0, 0.0), left, right) == pytest.approx(-angle, abs=1e-15)


def test_a_sheet_has_no_dihedral_angle():
    assert np.isnan(dihedral((0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)))
