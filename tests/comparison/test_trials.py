"""Noise against closed forms: estimators that return coordinates of the vertices."""

import numpy as np
import pandas as pd
import pytest

import curvlib
from curvlib.comparison.trials import NOISE_COLUMNS, NOISE_DRAWS, SIGMAS, noise_rows
from curvlib.meshes.key import MeshKey

SIDE = 40  # edges along a side of the plane
INSIDE = (SIDE - 1) ** 2
MEANS = ["value", "spread", "response", "response_spread"]


@pytest.fixture(scope="module")
def plane():
    """The plane z = 0 over the unit square, with its exact normals and K = H = 0."""
    i, j = np.indices((SIDE, SIDE)).reshape(2, -1)
    a = i * (SIDE + 1) + j
    faces = np.stack((a, a + SIDE + 1, a + SIDE + 2, a, a + SIDE + 2, a + 1), 1).reshape(-1, 3)
    x, y = np.indices((SIDE + 1, SIDE + 1)).reshape(2, -1) / SIDE
    zero = 0 * x
    up = np.stack((zero, zero, zero + 1), 1)
    return curvlib.Mesh(np.stack((x, y, zero), 1), faces, normals=up, K=zero, H=zero)


def edge(mesh):
    ends = mesh.vertices[mesh.faces]
    return np.linalg.norm(ends - np.roll(ends, 1, axis=1), axis=2).mean()


def heights(mesh):
    """K = 1 + z, H = x."""
    return 1 + mesh.vertices[:, 2], mesh.vertices[:, 0].copy()


def noisy(mesh, estimator, surface="plane", n=SIDE):
    rows = pd.DataFrame(noise_rows(MeshKey(surface, "same", n), mesh, estimator, {"-": {}}))
    assert set(zip(rows.surface, rows.n)) == {(surface, n)}
    assert tuple(rows.columns) == NOISE_COLUMNS
    return {quantity: table.set_index("sigma") for quantity, table in rows.groupby("quantity")}


def test_the_response_is_the_mean_absolute_deviate(plane):
    """sigma sqrt(2 / pi) mean edges for a height, nothing for what does not move; the error of K
    is 1 + z, with a mean of 1."""
    found = noisy(plane, heights)
    sigma = np.array(SIGMAS)
    count = NOISE_DRAWS * INSIDE
    expected = sigma * edge(plane) * np.sqrt(2 / np.pi)
    # The standard deviation of |N| is sqrt(1 - 2 / pi).
    tolerance = 4 * sigma * edge(plane) * np.sqrt((1 - 2 / np.pi) / count)
    assert (abs(found["K"].response - expected) <= tolerance).all()
    assert (abs(found["K"].value - 1) <= 4 * sigma * edge(plane) / np.sqrt(count)).all()
    assert (found["H"].response == 0).all()
    assert found["H"].value.tolist() == pytest.approx([0.5] * len(SIGMAS))
    spread = found["K"].response_spread[0.05] / (tolerance[-1] / 4)
    assert spread == pytest.approx(np.sqrt(NOISE_DRAWS), rel=0.7)
    assert found["K"].draws.tolist() == [1, *[NOISE_DRAWS] * (len(SIGMAS) - 1)]
    assert found["K"].loc[0.0, MEANS].tolist() == [1, 0, 0, 0]


def test_vertices_are_those_defined_in_every_draw_and_without_noise(plane):
    def some(mesh):
        K, H = heights(mesh)
        K[: 2 * (SIDE + 1)] = np.nan  # the boundary, and a row inside
        K[K < 1 - 0.025 * edge(plane)] = np.nan  # half a sigma below, at the largest sigma
        return K, np.full(len(H), np.nan)

    found = noisy(plane, some)
    assert found["K"].vertices[0.0] == found["K"].vertices[0.001] == INSIDE - (SIDE - 1)
    # Ten deviates above -1/2 have a probability of 0.69^10.
    assert 0.01 < found["K"].vertices[0.05] / INSIDE < 0.05
    assert found["K"].response[0.05] > 0
    assert set(found["H"].vertices) == {0}
    assert found["H"][MEANS].isna().all(axis=None)


def test_draws_differ_by_surface_and_n_and_not_by_estimator(plane):
    def doubled(mesh):
        K, H = heights(mesh)
        return 2 * K, H

    once, twice = noisy(plane, heights), noisy(plane, doubled)
    assert set(once["K"].vertices) == {INSIDE}
    np.testing.assert_allclose(twice["K"].response, 2 * once["K"].response, rtol=1e-12)
    keys = [(surface, n) for surface in ("sphere", "cone") for n in (16, 32)]
    responses = [noisy(plane, heights, *key)["K"].response[0.05] for key in keys]
    assert len(set(responses)) == 4
    assert noisy(plane, heights, *keys[-1])["K"].response[0.05] == responses[-1]


def test_exact_normals_are_gone():
    key = MeshKey("sphere", "same", 8)
    mesh = curvlib.tessellate(curvlib.surface(key.surface), key.n)
    assert mesh.moved(mesh.vertices).normals is None
    variants = {f"normal={value}": {"normal": value} for value in ("uniform", "exact")}
    rows = pd.DataFrame(noise_rows(key, mesh, "taubin", variants))
    assert set(rows.variant) == {"normal=uniform"}
    assert set(rows.vertices) == {len(mesh.vertices)}
    assert list(noise_rows(key, mesh, "taubin", {"normal=exact": {"normal": "exact"}})) == []
