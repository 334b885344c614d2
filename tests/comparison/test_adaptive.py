"""The comparison of `adaptive_fit` with fixed fits: meshes, noise, tables."""

import numpy as np
import pytest

import curvlib
from curvlib.comparison import adaptive
from curvlib.estimation import estimate


@pytest.mark.parametrize("surface", adaptive.SURFACES)
def test_exact_values_are_those_that_a_fit_converges_to(surface):
    """A sign or a factor that is wrong would leave an error that no refinement takes away."""
    errors = []
    for n in (30, 60):
        mesh = adaptive.SURFACES[surface](n, 1)
        assert len(mesh.vertices) == n * n
        found = estimate((mesh.vertices, mesh.faces), "jet", degree=4, rings=2)
        inner = ~mesh.boundary
        errors.append(
            [np.abs(found.K - mesh.K)[inner].mean(), np.abs(found.H - mesh.H)[inner].mean()]
        )
        turned = (mesh.normals * np.roll(mesh.normals, 1, axis=0)).sum(1)
        assert np.isfinite(turned).all()
    assert (np.array(errors[1]) < np.array(errors[0]) / 5).all()


def test_kinds_of_noise():
    mesh = adaptive.SURFACES["ring"](30, 2)

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
    monkeypatch.setattr(adaptive, "SURFACES", {"ring": adaptive.SURFACES["ring"]})
    table = adaptive.table(20, 4)
    assert len(adaptive.fixed()) >= 25
    assert len(table) == 2 * (1 + len(adaptive.fixed()))
    of_H = table[table.quantity == "H"].set_index("fit")
    own = of_H.loc["adaptive_fit"]
    assert own.ratio == pytest.approx(own.value / of_H.drop("adaptive_fit").value.min())
    mesh = adaptive.SURFACES["ring"](20, 4)
    moved = adaptive.noisy(mesh, "white", 0.01, 4)
    error = np.abs(curvlib.estimate(moved, "jet", degree=2, rings=3).H - mesh.H).mean()
    assert of_H.loc["jet(degree=2, rings=3)"].value == pytest.approx(error)
    found = adaptive.ratios(table)
    assert found.cases.tolist() == [1, 1]
    assert found["mean"].tolist() == pytest.approx(found.worst.tolist())
