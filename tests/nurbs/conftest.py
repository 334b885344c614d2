"""Surfaces of the package and of one's own, and parameters to look at them."""

import numpy as np
import pytest

import curvlib
from curvlib.surfaces._shapes import nurbs


@pytest.fixture(params=curvlib.surfaces())
def surface(request):
    """Every surface of the package in turn."""
    return curvlib.surface(request.param)


@pytest.fixture
def interior():
    def points(surface, count, seed=0, margin=0.0):
        """Random parameters inside the domain, off every knot line."""
        (u0, u1), (v0, v1) = surface.domain
        a, b = np.random.default_rng(seed).random((2, count)) * (1 - 2 * margin) + margin
        return u0 + (u1 - u0) * a, v0 + (v1 - v0) * b

    return points


@pytest.fixture
def everywhere():
    """Parameters of every kind in the unit square: anywhere, on seams, knot lines and poles, and
    close to poles."""
    v = np.r_[0, 1e-9, 1e-4, 0.25, 0.5, 0.75, 1 - 1e-4, 1 - 1e-9, 1, np.linspace(0, 1, 51)]
    return np.r_[np.random.default_rng(4).random(300), np.linspace(0, 1, 17)], v[:, None]


@pytest.fixture
def build():
    """A Surface from degrees, knots, net (nu, nv, 3) and weights (nu, nv)."""
    return lambda *arguments, name="": curvlib.Surface(nurbs(*arguments), name)
