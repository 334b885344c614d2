"""The comparison of `adaptive_fit` with fixed fits: meshes, noise, tables."""

import numpy as np
import pytest

import curvlib
from curvlib.comparison import adaptive
from curvlib.comparison.held_out import held_out


def test_kinds_of_noise():
    mesh = held_out("ring", 30, 2)

    def moves(noise, level):
        return (adaptive.noisy(mesh, noise, level, 3).vertices - mesh.vertices) / mesh.mean_edge

    along = (moves("white", 0.05) * mesh.normals).sum(1)
    assert along.std() == pytest.approx(0.05, rel=0.1)
    assert np.abs(moves("white", 0.05) - along[:, None] * mesh.normals).max() < 1e-12
    assert np.abs(moves("quantised", 0.1)).max() <= 0.05 + 1e-12
    assert moves("isotropic", 0.05).std() == pytest.approx(0.05, rel=0.1)
    still = np.linalg.norm(moves("half", 0.05), axis=1) == 0
    assert (still == (mesh.vertices[:, 0] <= np.median(mesh.vertices[:, 0]))).all()
    far = np.linalg.norm(moves("outliers", 0.01), axis=1)
    assert (far > 4.9).sum() == int(adaptive.PART * 900)
    assert np.abs(moves("float32", 0.0)).max() < 1e-5
    smooth = (moves("correlated", 0.05) * mesh.normals).sum(1)
    assert smooth.std() == pytest.approx(0.05)
    a, b = mesh.faces[:, 0], mesh.faces[:, 1]
    assert (
        np.corrcoef(smooth[a], smooth[b])[0, 1] > 0.5 > abs(np.corrcoef(along[a], along[b])[0, 1])
    )


def test_table(monkeypatch):
    """A row for each fit and quantity; ratios to the least of the fixed ones."""
    monkeypatch.setattr(adaptive, "LEVELS", {"white": (0.01,)})
    monkeypatch.setattr(adaptive, "SURFACES", ["ring"])
    table = adaptive.table(20, 4)
    assert len(adaptive.fixed()) >= 25
    assert len(table) == 2 * (1 + len(adaptive.fixed()))
    of_H = table[table.quantity == "H"].set_index("fit")
    own = of_H.loc["adaptive_fit"]
    assert own.ratio == pytest.approx(own.value / of_H.drop("adaptive_fit").value.min())
    mesh = held_out("ring", 20, 4)
    moved = adaptive.noisy(mesh, "white", 0.01, 4)
    error = np.abs(curvlib.estimate(moved, "jet", degree=2, rings=3).H - mesh.H).mean()
    assert of_H.loc["jet(degree=2, rings=3)"].value == pytest.approx(error)
    found = adaptive.ratios(table)
    assert found.cases.tolist() == [1, 1]
    assert found["mean"].tolist() == pytest.approx(found.worst.tolist())
