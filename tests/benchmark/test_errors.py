"""Errors of the benchmark: their scale, places, what is undefined; orders."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from curvlib.benchmark.errors import COLUMNS, error_rows, measured, meshes, orders
from curvlib.benchmark.methods import methods, versions
from curvlib.catalogue import families
from curvlib.comparison.calls import Call
from curvlib.estimation import estimate
from curvlib.meshes.mesh import Mesh

FLAT = '''"""A flat surface everywhere."""
import numpy as np

LABEL = "Flat"


def estimate(mesh):
    """K = 0, and H = 1 but at the first vertex."""
    H = np.ones(len(mesh.vertices))
    H[0] = np.nan
    return 0 * H, H
'''


@pytest.fixture
def flat(tmp_path):
    path = tmp_path / "flat.py"
    path.write_text(FLAT.replace("0 * H, H", "np.zeros(len(H)), H"), encoding="utf-8")
    return str(path)


def plan(*calls, n=12):
    return SimpleNamespace(
        seed=1,
        calls=lambda: list(calls),
        resolutions=lambda family: [n],
        noise={"family": "jittered", "surfaces": ["torus"], "n": n, "levels": [0.01, 0.1]},
    )


def test_errors_are_those_of_the_definition_and_free_of_the_unit(flat):
    rows = []
    for size in (1.0, 1000.0):
        mesh = families.module("jittered").make("patch", 16, 1)
        scaled = {name: getattr(mesh, name) / size for name in ("H", "k1", "k2")}
        fields = scaled | {"K": mesh.K / size**2, "normals": mesh.normals}
        big = Mesh(mesh.vertices * size, mesh.faces, d1=mesh.d1, d2=mesh.d2, **fields)
        found = estimate(big, flat)
        rows.append({(r["place"], r["quantity"], r["norm"]): r for r in error_rows(big, found)})
    one, thousand = rows
    inside, largest = ~mesh.boundary, np.abs([mesh.k1, mesh.k2]).max()
    mean = one["interior", "K", "mean"]
    assert mean["value"] == pytest.approx(np.abs(mesh.K)[inside].mean())
    assert mean["scaled"] == pytest.approx(mean["value"] / largest**2)
    assert mean["vertices"] == inside.sum()
    assert one["boundary", "K", "max"]["value"] == np.abs(mesh.K)[~inside].max()
    # H has a sign here: an estimate of 1 where H = -1 is 2 off.
    median = np.median(np.abs(mesh.H - 1)[inside])
    assert one["interior", "H", "median"]["value"] == pytest.approx(median)
    assert one["boundary", "H", "mean"]["undefined"] == 1
    assert thousand["interior", "K", "q95"]["value"] == pytest.approx(
        one["interior", "K", "q95"]["value"] / 1e6
    )
    key = ("interior", "K", "q95")
    assert thousand[key]["scaled"] == pytest.approx(one[key]["scaled"])


def test_a_part_of_the_plan(flat):
    errors, causes = measured(plan(Call(flat, {}), Call("taubin", {})), "open")
    table = pd.DataFrame(errors)
    assert set(table.columns) == set(COLUMNS)
    assert set(table.surface) == set(families.module("open").SURFACES)
    assert set(table.estimator) == {"flat", "taubin"}
    boundary = table[(table.estimator == "taubin") & (table.place == "boundary")]
    assert boundary.value.isna().all()
    assert (boundary.vertices == 0).all()
    told = {(row["estimator"], row["cause"]) for row in causes}
    assert ("taubin", "boundary") in told


def test_noise_moves_vertices_and_keeps_the_truth():
    found = list(meshes(plan(), "noise-white"))
    assert [labels["level"] for labels, _, _ in found] == [0.01, 0.1]
    for labels, exact, mesh in found:
        assert labels["noise"] == "white"
        moves = np.linalg.norm(mesh.vertices - exact.vertices, axis=1)
        assert moves.std() < labels["level"] * exact.mean_edge < 3 * moves.std()
        assert mesh.K is None


def test_a_peer_that_fails_does_not_stop_the_others(monkeypatch):
    from curvlib.catalogue import peers

    def fails(mesh):
        raise ValueError("of its own")

    monkeypatch.setattr(peers.module("vtk_curvatures"), "estimate", fails)
    errors, causes = measured(plan(Call("vtk_curvatures", {}), Call("taubin", {})), "fan")
    assert {row["estimator"] for row in errors} == {"taubin"}
    assert ("vtk_curvatures", "failed: ValueError") in {
        (row["estimator"], row["cause"]) for row in causes
    }


def test_orders_are_slopes():
    base = {"surface": "s", "family": "f", "noise": "none", "norm": "mean", "place": "interior"}
    rows = [
        base
        | {"estimator": "e", "quantity": "K", "n": n, "vertices_of_mesh": n * n}
        | {"value": 5.0 * n**-3, "scaled": n**-3.0}
        for n in (10, 20, 40)
    ]
    one = base | {"estimator": "once", "quantity": "K", "n": 8, "vertices_of_mesh": 64}
    table = orders(pd.DataFrame([*rows, one | {"value": 1.0, "scaled": 1.0}]))
    assert table.set_index("estimator").order["e"] == pytest.approx(3)
    assert np.isnan(table.set_index("estimator").order["once"])


def test_methods_name_libraries_and_versions():
    table = methods(plan(Call("jet", {"degree": 3}), Call("vtk_curvatures", {})))
    ours, theirs = table.to_dict("records")
    assert ours == {
        "estimator": "jet(degree=3)",
        "kind": "ours",
        "library": "",
        "version": "",
        "note": "",
    }
    assert theirs["library"] == "pyvista"
    assert theirs["version"] or theirs["note"] == "not installed"
    found = versions(SimpleNamespace(peers=["vtk_curvatures"]))
    assert found == ([f"vtk_curvatures {theirs['version']}"] if theirs["version"] else [])
