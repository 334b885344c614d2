"""A new quantity is one row: errors, tables and figures follow."""

from types import SimpleNamespace

import pandas as pd
import pytest

import curvlib
from curvlib.comparison import accuracy
from curvlib.comparison.norms import rounding_level
from curvlib.comparison.quantities import QUANTITIES, Quantity, absolute, difference
from curvlib.comparison.run import read_values, run_and_keep
from curvlib.comparison.trials import noise_rows
from curvlib.figures.curves import error_plot
from curvlib.figures.rings import rings_plot
from curvlib.meshes.key import MeshKey

MODULES = {
    "sphere": SimpleNamespace(LABEL="Sphere"),
    "taubin": SimpleNamespace(LABEL="Taubin", STYLE={"color": "black", "marker": "o"}),
}


@pytest.fixture
def k1(monkeypatch):
    row = Quantity("k1", "larger principal curvature k1", "per length", 1, absolute)
    monkeypatch.setitem(QUANTITIES, "k1", row)


def test_a_third_quantity_is_one_row(k1, tmp_path):
    sphere = curvlib.surface("sphere")
    meshes = {MeshKey("sphere", "same", n): curvlib.tessellate(sphere, n) for n in (8, 12, 16)}
    values, errors = tmp_path / "taubin.h5", tmp_path / "taubin.csv"
    run_and_keep("taubin", {"-": {}}, meshes, errors, values)
    key = next(iter(meshes))
    mesh, estimates = meshes[key], read_values(values)[key]
    error = abs(mesh.k1 - estimates.k1)[~mesh.boundary]

    readings = {"reading": "default", "estimator": "taubin", "variant": "-", "more": False}
    readings = pd.DataFrame([readings | {"counted": "interior"}])
    rows = accuracy.by_variant([pd.read_csv(errors)], readings, list(meshes), [])
    table = accuracy.errors(rows, readings)
    assert set(table.quantity) == {"K", "H", "k1"}
    (of_coarsest,) = table.value[(table.quantity == "k1") & (table.norm == "mean") & (table.n == 8)]
    assert of_coarsest == pytest.approx(error.mean())
    curves = accuracy.curves(rows, readings)
    assert set(accuracy.ranks(table, rows).quantity) == set(curves.quantity) == {"K", "H", "k1"}
    (level,) = set(curves.rounding[curves.quantity == "k1"])
    assert level == pytest.approx(rounding_level("k1", 1.0))

    convergence = accuracy.convergence(curves, readings)
    (axes,) = error_plot(table, convergence, "sphere", "k1", MODULES).axes
    assert axes.get_ylabel() == "mean absolute error of k1 (per length)"
    assert axes.get_title(loc="left") == "Sphere, larger principal curvature k1"
    (line,) = (line for line in axes.lines if line.get_label() == "Taubin")
    assert line.get_ydata()[0] == pytest.approx(error.mean())


def test_trials_of_a_third_quantity(k1):
    mesh = curvlib.tessellate(curvlib.surface("sphere"), 8)
    rows = pd.DataFrame(noise_rows(MeshKey("sphere", "same", 8), mesh, "taubin", {"-": {}}))
    clean = rows[rows.sigma == 0].set_index("quantity").value
    estimates = curvlib.estimate(mesh, "taubin")
    for quantity in QUANTITIES:
        error = QUANTITIES[quantity].error(getattr(mesh, quantity), getattr(estimates, quantity))
        assert clean[quantity] == pytest.approx(error[~mesh.boundary].mean())
    rings = pd.DataFrame(
        {"estimator": "taubin", "variant": "-", "ring": kind, "valence": 6, "quantity": "k1"}
        | {"h": h, "value": h}
        for kind in ("regular", "irregular")
        for h in (0.5, 0.25)
    )
    slopes = accuracy.ring_slopes(rings)
    figure = rings_plot(rings, slopes, [("taubin", "-", "Taubin")], "k1")
    assert figure.texts[-1].get_text() == r"mean of $|k1 - k1_\mathrm{est}|$ (per length)"


@pytest.mark.parametrize(
    ("quantity", "tex"),
    [("K", r"$|K - K_\mathrm{est}|$"), ("H", r"$||H| - |H_\mathrm{est}||$")],
)
def test_how_an_error_is_written_follows_the_symbol(quantity, tex):
    assert difference(quantity, QUANTITIES[quantity].symbol) == tex
