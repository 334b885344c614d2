"""What an estimator comes to, on disk: values come back bit for bit, or nothing is there."""

import h5py
import numpy as np
import pandas as pd
import pytest

import curvlib
from curvlib.comparison import accuracy
from curvlib.comparison import run as run_module
from curvlib.comparison.norms import NORMS
from curvlib.comparison.run import (
    COLUMNS,
    read_values,
    run_and_keep,
    run_estimator,
    write_rows,
)
from curvlib.meshes.key import MeshKey

NAMES = ("sphere", "teapot_spout")
VARIANTS = {"normal=uniform": {"normal": "uniform"}, "normal=area": {"normal": "area"}}


@pytest.fixture(scope="module")
def meshes():
    return {
        MeshKey(name, "same", n): curvlib.tessellate(curvlib.surface(name), n)
        for name in NAMES
        for n in (8, 12)
    }


def run(meshes, folder, estimator="watanabe_b", variants=VARIANTS):
    """An estimator in its variants: the paths of values and errors."""
    values, errors = folder / "e.h5", folder / "e.csv"
    run_and_keep(estimator, variants, meshes, errors, values, code="x")
    return values, errors


def test_estimates_come_back(meshes, tmp_path):
    values, errors = run(meshes, tmp_path)
    found = read_values(values)
    assert set(found) == set(meshes)
    for key, estimates in found.items():
        again = curvlib.estimate(meshes[key], "watanabe_b")
        assert set(vars(estimates)) == {"K", "H"}
        for quantity in vars(estimates):
            np.testing.assert_array_equal(getattr(estimates, quantity), getattr(again, quantity))
    with h5py.File(values) as file:
        assert dict(file.attrs) == {"code": "x", "options": "normal=uniform"}
    errors = pd.read_csv(errors)
    assert tuple(errors.columns) == COLUMNS
    assert set(errors.variant) == set(VARIANTS)
    assert set(errors.counted[errors.surface == "sphere"]) == {"interior", "without-poles"}
    assert set(errors.counted[errors.surface == "teapot_spout"]) == {"interior"}


def test_a_mesh_is_run_in_the_variants_chosen_for_it(meshes):
    def chosen(key):
        return VARIANTS if key.n == 8 else ["normal=area"]

    rows = pd.DataFrame(run_estimator("watanabe_b", VARIANTS, meshes, chosen))
    assert set(rows.variant[rows.n == 8]) == set(VARIANTS)
    assert set(rows.variant[rows.n == 12]) == {"normal=area"}
    assert set(rows.columns) == set(COLUMNS)


def test_an_estimator_without_a_value_has_rows_that_count_what_is_undefined(meshes, tmp_path):
    nothing = tmp_path / "nothing.py"
    nothing.write_text(
        "import numpy as np\nLABEL = 'Nothing'\nSTYLE = {}\n\n\ndef estimate(mesh):\n"
        "    nan = np.full(len(mesh.vertices), np.nan)\n    return nan, nan\n"
    )
    _, errors = run(meshes, tmp_path, str(nothing), {"-": {}})
    table = pd.read_csv(errors)
    assert set(table.estimator) == {"nothing"}
    assert table[list(NORMS)].isna().all(axis=None)
    assert set(table.vertices) == {0}
    everywhere = table[(table.counted == "interior") & (table.quantity == "K")]
    assert everywhere.undefined.tolist() == [len(mesh.vertices) for mesh in meshes.values()]


@pytest.mark.parametrize("broken", ["values", "errors"])
def test_nothing_half_written(meshes, tmp_path, monkeypatch, broken):
    """Neither file is there where the last mesh, or the writing of either file, fails."""
    if broken == "values":
        meshes = meshes | {MeshKey("sphere", "same", 16): None}
    else:
        monkeypatch.setattr(run_module, "COLUMNS", COLUMNS[1:])
    with pytest.raises((AttributeError, ValueError)):
        run(meshes, tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_without_a_row_there_is_the_header(tmp_path):
    write_rows(tmp_path / "none.csv", ("a", "b"), [])
    assert (tmp_path / "none.csv").read_text() == "a,b\n"


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (lambda lines: [*lines[:3], "garbage\n", *lines[3:]], "line 4 is damaged"),
        (lambda lines: [*lines[:2], lines[2].replace("sphere", "")], "line 3 is damaged"),
        (lambda lines: [*lines[:2], lines[2].replace(",8,", ",eight,", 1)], "line 3 is damaged"),
        (lambda lines: [*lines, lines[1].strip() + ",more,and,more\n"], "no table"),
        (lambda lines: [], "no table"),
    ],
)
def test_a_damaged_table_is_told(meshes, tmp_path, damage, message):
    _, errors = run(meshes, tmp_path)
    pd.testing.assert_frame_equal(accuracy.read(errors), pd.read_csv(errors))
    lines = errors.read_text().splitlines(keepends=True)
    errors.write_text("".join(damage(lines)))
    with pytest.raises(curvlib.InputError, match=f"e.csv: {message}.*; delete"):
        accuracy.read(errors)
