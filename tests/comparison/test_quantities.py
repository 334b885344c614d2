"""A quantity is one row: errors, tables and figures follow; which vertices and estimators count."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

import curvlib
from curvlib.catalogue import estimators
from curvlib.comparison import accuracy
from curvlib.comparison.norms import error_rows, rounding_level
from curvlib.comparison.quantities import QUANTITIES, Quantity, angle, compared, difference
from curvlib.comparison.run import read_values, run_and_keep
from curvlib.comparison.trials import noise_rows, ring_rows
from curvlib.figures.curves import error_plot
from curvlib.figures.rings import rings_plot
from curvlib.kit.tensor import Curvatures
from curvlib.meshes.key import MeshKey

MODULES = {
    "ellipsoid": SimpleNamespace(LABEL="Ellipsoid"),
    "quadric": SimpleNamespace(LABEL="Quadric", STYLE={"color": "black", "marker": "o"}),
}
NAMES = {"K", "H", "k1", "k2", "d1"}


@pytest.fixture
def d2(monkeypatch):
    row = Quantity("d2", "direction d2 of k2", "degrees", 0, angle, angle)
    monkeypatch.setitem(QUANTITIES, "d2", row)


def apart(mesh):
    """Where the surface is not nearly umbilic."""
    return (mesh.k1 - mesh.k2) / (abs(mesh.k1) + abs(mesh.k2)) > 0.05


def test_a_further_quantity_is_one_row(d2, tmp_path):
    surface = curvlib.surface("ellipsoid")
    meshes = {MeshKey("ellipsoid", "same", n): curvlib.tessellate(surface, n) for n in (8, 12, 16)}
    values, errors = tmp_path / "quadric.h5", tmp_path / "quadric.csv"
    run_and_keep("quadric", {"-": {}}, meshes, errors, values)
    key = next(iter(meshes))
    mesh, estimates = meshes[key], read_values(values)[key]
    along = abs((mesh.d2 * estimates.d2).sum(1))[apart(mesh) & ~mesh.boundary]
    error = np.degrees(np.arccos(along))

    readings = {"reading": "default", "estimator": "quadric", "variant": "-", "more": False}
    readings = pd.DataFrame([readings | {"counted": "interior"}])
    rows = accuracy.by_variant([accuracy.read(errors)], readings, list(meshes), [])
    table = accuracy.errors(rows, readings)
    assert set(table.quantity) == {*NAMES, "d2"}
    (of_coarsest,) = table.value[(table.quantity == "d2") & (table.norm == "mean") & (table.n == 8)]
    assert of_coarsest == pytest.approx(error.mean(), rel=1e-6)
    curves = accuracy.curves(rows, readings)
    assert set(accuracy.ranks(table, rows).quantity) == set(curves.quantity) == {*NAMES, "d2"}
    (level,) = set(curves.rounding[curves.quantity == "d2"])
    assert level == rounding_level("d2", 7.0) == 1e-9

    convergence = accuracy.convergence(curves, readings)
    (axes,) = error_plot(table, convergence, "ellipsoid", "d2", MODULES).axes
    assert axes.get_ylabel() == "mean absolute error of d2 (degrees)"
    assert axes.get_title(loc="left") == "Ellipsoid, direction d2 of k2"
    (line,) = (line for line in axes.lines if line.get_label() == "Quadric")
    assert line.get_ydata()[0] == pytest.approx(error.mean(), rel=1e-6)


def test_noise_of_every_quantity():
    mesh = curvlib.tessellate(curvlib.surface("ellipsoid"), 8)
    key = MeshKey("ellipsoid", "same", 8)
    rows = pd.DataFrame(noise_rows(key, mesh, "quadric", {"-": {}}))
    found = rows.set_index(["quantity", "sigma"])
    estimates = curvlib.estimate(mesh.moved(mesh.vertices), "quadric")
    inside = ~mesh.boundary
    for name, size in (("K", 1), ("k1", 1), ("k2", 1), ("d1", 90)):
        error = QUANTITIES[name].error(getattr(mesh, name), getattr(estimates, name))
        there = inside & np.isfinite(error) & (apart(mesh) if name == "d1" else True)
        clean, noisy = found.loc[(name, 0.0)], found.loc[(name, 0.05)]
        assert clean.value == pytest.approx(error[there].mean(), rel=1e-12)
        assert (clean.response, clean.vertices) == (0, there.sum())
        assert 0 < noisy.response < size * 10
        assert noisy.draws == 10


def test_rings_of_every_quantity():
    """An estimator that returns what the quadric has at the centre is right but for rounding; in
    rings about the centre d1 is one of the axes."""

    def along_x(ring):
        m = ring.e.shape[2]
        x, zero = np.eye(3)[0], np.zeros(m)
        d1 = np.repeat(x[:, None], m, axis=1)
        return Curvatures(zero, zero, zero, zero, d1, d1)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(estimators, "module", lambda name: SimpleNamespace(estimate=along_x))
        rows = pd.DataFrame(ring_rows("along_x", {"-": {}}))
    assert set(rows.quantity) == NAMES
    d1 = rows[rows.quantity == "d1"]
    # As often along x as along y, and some draws nearly umbilic.
    assert d1.value.between(30, 60).all()
    assert d1.undefined.between(1, 20).all()
    assert (rows.undefined[rows.quantity != "d1"] == 0).all()
    assert (rows.value[rows.quantity == "k1"] > 0.1).all()
    rings = d1.assign(estimator="along_x")
    slopes = accuracy.ring_slopes(rings)
    figure = rings_plot(rings, slopes, [("along_x", "-", "Along x")], "d1")
    assert figure.texts[-1].get_text() == r"mean of $|d1 - d1_\mathrm{est}|$ (degrees)"


@pytest.mark.parametrize("turned", [0, 1e-9, 1e-3, 30, 90, 150, 180, 359])
def test_angle_between_directions_without_sense(turned):
    rng = np.random.default_rng(0)
    a, b, _ = np.linalg.qr(rng.standard_normal((3, 3)))[0]
    along = np.cos(np.radians(turned)) * a + np.sin(np.radians(turned)) * b
    expected = min(turned % 180, -turned % 180)
    assert angle(a, along) == pytest.approx(expected, rel=1e-6, abs=1e-13)
    np.testing.assert_allclose(angle(a, np.stack((along, -along))), expected, rtol=1e-6, atol=1e-13)


def test_directions_away_from_umbilics():
    """Of three vertices with (k1 - k2) / (|k1| + |k2|) = 0.04, 0.06 and 1, and a flat one."""
    k1, k2 = np.array([1.04, 1.06, 1.0, 0.0]), np.array([0.96, 0.94, -1.0, 0.0])
    x, y = np.tile(np.eye(3)[:2, None], (1, 4, 1))
    exact = SimpleNamespace(K=k1 * k2, k1=k1, k2=k2, d1=x, boundary=np.zeros(4, bool))
    estimates = SimpleNamespace(K=k1 * k2, k1=k1, k2=-k2, d1=y, returned=("K", "k1", "k2", "d1"))
    left_out = np.isnan(compared(exact, estimates)["d1"][0]).all(1)
    assert left_out.tolist() == [True, False, False, True]
    found = pd.DataFrame(error_rows(exact, estimates, np.ones(4, bool))).set_index("quantity")
    assert found.vertices.to_dict() == {"K": 4, "k1": 4, "k2": 4, "d1": 2}
    assert found.undefined["d1"] == 2
    assert found.loc["d1", ["mean", "max", "mean-signed"]].tolist() == pytest.approx([90] * 3)
    # The sign of a principal curvature counts: only |H| is blind to it.
    assert found["mean"]["k2"] == pytest.approx(2 * (0.96 + 0.94 + 1) / 4)


def test_an_estimator_has_rows_of_what_it_returns():
    mesh = curvlib.tessellate(curvlib.surface("ellipsoid"), 8)
    inside = np.ones(len(mesh.vertices), bool)

    def quantities(estimator):
        estimates = curvlib.estimate(mesh, estimator)
        return [row["quantity"] for row in error_rows(mesh, estimates, inside)]

    assert quantities("gauss_bonnet") == ["K", "H"]
    assert quantities("jet") == ["K", "H", "k1", "k2", "d1"]
    assert quantities(lambda ring: (None, ring.squares.sum(0))) == ["H"]
    bare = curvlib.Mesh(mesh.vertices, mesh.faces, K=mesh.K)
    rows = error_rows(bare, curvlib.estimate(bare, "jet"), inside)
    assert [row["quantity"] for row in rows] == ["K"]


@pytest.mark.parametrize(
    ("quantity", "tex"),
    [("K", r"$|K - K_\mathrm{est}|$"), ("H", r"$||H| - |H_\mathrm{est}||$")],
)
def test_how_an_error_is_written_follows_the_symbol(quantity, tex):
    assert difference(quantity, QUANTITIES[quantity].symbol) == tex
