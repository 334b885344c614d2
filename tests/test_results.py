"""Estimates on disk: values come back bit for bit, or nothing is there."""

import numpy as np
import pytest

import curvlib
from curvlib.results import read_estimates, write_estimates


def test_estimates_come_back(tmp_path):
    mesh = curvlib.tessellate(curvlib.surface("sphere"), 8)
    made = curvlib.estimate(mesh, "paraboloid")
    key = (("sphere", "same", 8), "normal=uniform")
    write_estimates(tmp_path / "e.h5", [(*key, made)], code="abc")
    found = read_estimates(tmp_path / "e.h5")
    assert list(found) == [key]
    for a, b in zip(found[key], made):
        np.testing.assert_array_equal(a, b)


def test_nothing_half_written(tmp_path):
    def fails():
        yield ("sphere", "same", 8), "-", curvlib.Estimates(np.zeros(3), np.zeros(3))
        raise RuntimeError("in the middle")

    with pytest.raises(RuntimeError, match="in the middle"):
        write_estimates(tmp_path / "e.h5", fails())
    assert list(tmp_path.iterdir()) == []
