"""Meshes of the tests of estimators."""

import pytest

import curvlib


@pytest.fixture(scope="session")
def sphere():
    return curvlib.tessellate(curvlib.surface("sphere"), 16, "random", seed=3)


@pytest.fixture(scope="session")
def ellipsoid():
    return curvlib.tessellate(curvlib.surface("ellipsoid"), 12, "random", seed=5)
