"""The comparison of `adaptive_fit` with fixed fits: meshes, noise, tables."""

import numpy as np
import pytest

import curvlib
from curvlib.comparison import adaptive
from curvlib.comparison.held_out import held_out
from curvlib.meshes.noise import noisy


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
    moved = noisy(mesh, "white", 0.01, 4)
    error = np.abs(curvlib.estimate(moved, "jet", degree=2, rings=3).H - mesh.H).mean()
    assert of_H.loc["jet(degree=2, rings=3)"].value == pytest.approx(error)
    found = adaptive.ratios(table)
    assert found.cases.tolist() == [1, 1]
    assert found["mean"].tolist() == pytest.approx(found.worst.tolist())
