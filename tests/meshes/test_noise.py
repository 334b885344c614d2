"""Kinds of noise on meshes."""

import numpy as np
import pytest

from curvlib.errors import InputError
from curvlib.meshes.jittered import jittered
from curvlib.meshes.noise import KINDS, PART, noisy


def test_kinds_of_noise():
    mesh = jittered("torus", 30, 2)

    def moves(noise, level):
        return (noisy(mesh, noise, level, 3).vertices - mesh.vertices) / mesh.mean_edge

    along = (moves("white", 0.05) * mesh.normals).sum(1)
    assert along.std() == pytest.approx(0.05, rel=0.1)
    assert np.abs(moves("white", 0.05) - along[:, None] * mesh.normals).max() < 1e-12
    assert np.abs(moves("quantised", 0.1)).max() <= 0.05 + 1e-12
    assert moves("isotropic", 0.05).std() == pytest.approx(0.05, rel=0.1)
    still = np.linalg.norm(moves("half", 0.05), axis=1) == 0
    assert (still == (mesh.vertices[:, 0] <= np.median(mesh.vertices[:, 0]))).all()
    far = np.linalg.norm(moves("outliers", 0.01), axis=1)
    assert (far > 4.9).sum() == int(PART * 900)
    grown = (moves("uneven", 0.05) * mesh.normals).sum(1)
    x = mesh.vertices[:, 0]
    near, far_away = x < np.quantile(x, 0.2), x > np.quantile(x, 0.8)
    assert grown[near].std() < 0.02
    assert grown[far_away].std() > 0.08
    assert np.abs(moves("float32", 0.0)).max() < 1e-5
    smooth = (moves("correlated", 0.05) * mesh.normals).sum(1)
    assert smooth.std() == pytest.approx(0.05)
    a, b = mesh.faces[:, 0], mesh.faces[:, 1]
    assert (
        np.corrcoef(smooth[a], smooth[b])[0, 1] > 0.5 > abs(np.corrcoef(along[a], along[b])[0, 1])
    )


@pytest.mark.parametrize("kind", sorted(set(KINDS) - {"outliers", "float32"}))
def test_without_a_level_nothing_moves(kind):
    mesh = jittered("patch", 8)
    assert (noisy(mesh, kind, 0.0, 1).vertices == mesh.vertices).all()


def test_an_unknown_kind_is_told_with_the_nearest():
    with pytest.raises(InputError, match="quantised"):
        noisy(jittered("patch", 8), "quantized", 0.1, 1)
