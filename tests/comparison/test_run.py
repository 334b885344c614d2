"""What an estimator comes to, on disk: values come back bit for bit, or nothing is there."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

import curvlib
from curvlib.comparison.run import read_values, run_estimator

NAMES = ("sphere", "teapot_spout")
VARIANTS = {"normal=uniform": {"normal": "uniform"}, "normal=area": {"normal": "area"}}


@pytest.fixture(scope="module")
def meshes():
    return {
        (name, "same", n): curvlib.tessellate(curvlib.surface(name), n)
        for name in NAMES
        for n in (8, 12)
    }


def run(meshes, folder):
    """Watanabe B in two variants, both on n = 8 alone."""
    output = SimpleNamespace(values=folder / "e.h5", errors=folder / "e.csv")
    surfaces = {name: curvlib.surface(name) for name in NAMES}
    more = ["normal=uniform"]
    run_estimator("watanabe_b", VARIANTS, more, meshes, surfaces, {("same", 8)}, output, code="x")
    return output


def test_estimates_come_back(meshes, tmp_path):
    output = run(meshes, tmp_path)
    found = read_values(output.values)
    assert list(found) == [(name, "same", 8) for name in NAMES]
    for key, values in found.items():
        for a, b in zip(values, curvlib.estimate(meshes[key], "watanabe_b")):
            np.testing.assert_array_equal(a, b)
    errors = pd.read_csv(output.errors)
    assert set(errors.variant[errors.n == 8]) == set(VARIANTS)
    assert set(errors.variant[errors.n == 12]) == {"normal=uniform"}
    assert set(errors.counted[errors.surface == "sphere"]) == {"interior", "without-poles"}
    assert set(errors.counted[errors.surface == "teapot_spout"]) == {"interior"}


def test_nothing_half_written(meshes, tmp_path):
    with pytest.raises(AttributeError):
        run(meshes | {("sphere", "same", 12): None}, tmp_path)
    assert list(tmp_path.iterdir()) == []
