"""Statistics over areas, against sums by hand."""

import numpy as np
import pytest

from curvlib import Mesh
from curvlib.regions import by_region, integral, quantiles, shares

# Two triangles: areas 1/2 and 3/2.
MESH = Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 3]], [[0, 1, 2], [0, 2, 3]])


def test_quantiles_weigh_by_area():
    """Of values at triangles: a quarter of the area has 1, the rest 2."""
    found = quantiles(MESH, np.array([1.0, 2.0]), "face", (0.01, 0.9))
    np.testing.assert_allclose(found, [1, 2])
    rng = np.random.default_rng(0)
    grid = np.arange(20.0)
    many = Mesh(
        np.column_stack((np.repeat(grid, 20), np.tile(grid, 20), np.zeros(400))),
        [[20 * i + j, 20 * i + j + 20, 20 * i + j + 1] for i in range(19) for j in range(19)],
    )
    values = rng.normal(size=len(many.faces))
    # Triangles of equal area: the plain quantiles, to the spacing of the values.
    np.testing.assert_allclose(
        quantiles(many, values, "face"),
        np.quantile(values, (0.05, 0.25, 0.5, 0.75, 0.95)),
        atol=0.05,
    )


def test_undefined_values_count_for_nothing():
    assert quantiles(MESH, np.array([np.nan, 2.0]), "face", (0.5,))[0] == 2
    assert np.isnan(quantiles(MESH, np.full(4, np.nan))).all()


def test_regions_of_triangles_and_of_vertices():
    K = np.array([1.0, 3.0, np.nan, 5.0])
    first, second = by_region(MESH, np.array([7, 8]), "face", {"K": K}, "vertex", {7: "a", 8: "b"})
    assert (first["region"], first["name"], second["name"]) == (7, "a", "b")
    # Corners of the first triangle: a sixth each, K of 1, 3 and none.
    assert first["area"] == pytest.approx(1 / 3)
    assert first["undefined"] == pytest.approx(1 / 6)
    assert first["mean"] == pytest.approx(2)
    assert first["deviation"] == pytest.approx(1)
    assert second["mean"] == pytest.approx(3)
    assert sum(second[f"bar_{k}"] for k in range(1, 11)) == pytest.approx(1)
    rows = by_region(
        MESH, np.array([0, 0, 1, 1]), "vertex", {"K": K, "d1": np.ones((4, 3))}, "vertex"
    )
    assert [row["region"] for row in rows] == [0, 1]
    # Region 0 has vertex 0 in both triangles, and vertex 1 in the first.
    assert rows[0]["area"] == pytest.approx(1 / 6 + 1 / 2 + 1 / 6)
    assert rows[0]["mean"] == pytest.approx((2 / 3 * 1 + 1 / 6 * 3) / (5 / 6))


def test_integrals_and_shares():
    K = np.array([1.0, 3.0, np.nan, 5.0])
    # The corners of vertices 0 and 1 have a sixth of a unit of area in the first triangle.
    assert integral(MESH, K) == pytest.approx(1 / 6 + 3 / 6 + 1 / 2 + 5 / 2)
    assert integral(MESH, np.array([np.nan, 2.0]), "face") == pytest.approx(3)
    assert np.isnan(integral(MESH, np.full(4, np.nan)))
    codes = np.array([2.0, 0.0, np.nan, 2.0])
    np.testing.assert_allclose(shares(MESH, codes, 4), [1 / 8, 0, 7 / 8, 0])
    assert np.isnan(shares(MESH, np.full(4, np.nan), 2)).all()
