"""Coverage of standard errors: what the table counts."""

import types

import numpy as np
import pytest

from curvlib.comparison import coverage
from curvlib.comparison.held_out import held_out
from curvlib.comparison.voxels import SPHERES


def test_rows_count_errors_within_standard_errors(monkeypatch):
    """An estimate that is off by known multiples of its standard errors."""
    mesh = held_out("wave", 16, 3)
    off = np.resize([0.5, 1.5, 1.5, 2.5], len(mesh.vertices))

    def estimate(given, name, threads):
        assert given is mesh
        assert name == "adaptive_fit"
        found = {q: getattr(mesh, q) + 0.1 * off for q in coverage.QUANTITIES}
        errors = {f"{q}_error": np.full(len(off), 0.1) for q in coverage.QUANTITIES}
        return types.SimpleNamespace(**found, **errors)

    monkeypatch.setattr(coverage, "estimate", estimate)
    rows = list(coverage._rows(mesh, mesh, 1, surface="wave"))
    assert [row["quantity"] for row in rows] == list(coverage.QUANTITIES)
    inner = ~mesh.boundary
    for row in rows:
        assert row["surface"] == "wave"
        assert row["vertices"] == inner.sum()
        assert row["within_1"] == pytest.approx((off[inner] < 1).mean())
        assert row["within_2"] == pytest.approx((off[inner] < 2).mean())
        assert row["ratio"] == pytest.approx(1.5)
        assert row["standard"] == pytest.approx(0.1)
        assert row["error"] == pytest.approx(0.15)


def test_table_and_summary(monkeypatch):
    monkeypatch.setattr(coverage, "SURFACES", ("ring",))
    monkeypatch.setattr(coverage, "LEVELS", {"white": (0.01, 0.1)})
    table = coverage.table((12, 20), seed=4)
    assert len(table) == 4 * (2 + 2 + sum(r <= 20 for r in SPHERES.values()))
    exact = table[table.noise == "none"]
    assert sorted(exact.n.unique()) == [12, 20]
    assert (table[table.noise == "white"].n == 20).all()
    assert table.within_1.between(0, 1).all()
    assert (table.within_1 <= table.within_2).all()
    mesh = held_out("ring", 20, 4)
    of_K = table[(table.noise == "white") & (table.quantity == "K")]
    assert of_K["size"].to_numpy() == pytest.approx(np.median(np.abs(mesh.K)))
    summary = coverage.summary(table).set_index(["noise", "quantity"])
    row = summary.loc["white", "K"]
    assert row.within_2 == pytest.approx(of_K.within_2.mean())
    assert row.least == of_K.within_2.min()
    assert row.cases == 2
