"""Errors on any mesh, in the readings that are asked for."""

import numpy as np
import pandas as pd
import pytest

import curvlib
from curvlib.claims.guesses import readings_on_shapes
from curvlib.comparison.norms import NORMS, ROUNDING
from curvlib.comparison.shapes import COLUMNS, elongation, shape_rows

BEST = "best-explanation"
ESTIMATORS = ("gauss_bonnet", "taubin_a", "paraboloid")
VARIANTS = {
    "default": ("area=third,dihedral=signed", "angles=one-sided", "normal=uniform"),
    BEST: ("area=third,dihedral=as-printed", "angles=one-sided", "normal=exact"),
    "dihedral=unsigned": ("area=third,dihedral=unsigned", "angles=one-sided", "normal=uniform"),
    "area=half": ("area=half,dihedral=signed", "angles=one-sided", "normal=uniform"),
}
OPTIONS = {
    stem: {v: dict(choice.split("=") for choice in v.split(",")) for v in variants}
    for stem, variants in zip(ESTIMATORS, zip(*VARIANTS.values()))
}


def table(*names, counted="interior"):
    return pd.DataFrame(
        {"reading": name, "kind": "named", "estimator": estimator, "variant": variant}
        | {"counted": counted, "more": True}
        for name in names
        for estimator, variant in zip(ESTIMATORS, VARIANTS[name])
    )


def test_best_explanation_with_every_other_angle():
    chosen = readings_on_shapes(table(*VARIANTS))
    found = {name: tuple(rows.variant) for name, rows in chosen.groupby("reading")}
    expected = {
        f"{BEST},dihedral={value}": (f"area=third,dihedral={value}", *VARIANTS[BEST][1:])
        for value in ("signed", "unsigned")
    }
    assert found == expected | {name: VARIANTS[name] for name in ("default", BEST)}


def test_only_variants_that_the_study_has():
    """No estimator has `dihedral=unsigned` beside what the best reading has else."""
    only = readings_on_shapes(table("default", BEST, "area=half"))
    assert set(only.reading) == {"default", BEST, f"{BEST},dihedral=signed"}
    without = table(*VARIANTS)
    without = readings_on_shapes(without[without.estimator != "gauss_bonnet"])
    assert set(without.reading) == {"default", BEST}
    assert set(readings_on_shapes(table("default", "area=half")).reading) == {"default"}


def test_elongation():
    vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    square = vertices, [[0, 1, 2], [0, 2, 3]]
    assert elongation(curvlib.Mesh(*square)) == pytest.approx(np.sqrt(2))
    assert elongation(curvlib.Mesh(vertices * (1, 5, 1), square[1])) == pytest.approx(np.sqrt(26))


def test_rows_are_the_errors_of_every_variant():
    radius = 4
    sphere = curvlib.tessellate(curvlib.surface("sphere"), 8)
    sphere = curvlib.Mesh(
        radius * sphere.vertices,
        sphere.faces,
        normals=sphere.normals,
        pole=sphere.pole,
        K=sphere.K / radius**2,
        **{name: getattr(sphere, name) / radius for name in ("H", "k1", "k2")},
    )
    cylinder = curvlib.tessellate(curvlib.surface("cylinder"), 8)
    labels = {"family": "f", "shape": 1, "proportions": "p", "diagonal": "same", "n": 8}
    shapes = [(labels | {"surface": "a"}, sphere), (labels | {"surface": "b"}, cylinder)]
    both = [table("default"), table(BEST, counted="without-poles")]
    readings = pd.concat([*both, table("default")])
    estimators = dict(zip(ESTIMATORS, ESTIMATORS))
    rows = pd.DataFrame(shape_rows(shapes, readings, estimators, OPTIONS))
    assert set(rows.columns) == set(COLUMNS)
    # taubin_a has one variant in both, counted in two ways; K and H of two shapes.
    assert len(rows) == 2 * 2 * 6
    assert not rows.duplicated(["surface", "estimator", "variant", "counted", "quantity"]).any()
    key = ["surface", "estimator", "variant", "counted", "quantity"]
    found = rows.set_index(key).sort_index()
    printed = "area=third,dihedral=as-printed"
    error = abs(curvlib.estimate(sphere, "gauss_bonnet", dihedral="as-printed").H - sphere.H)
    near = np.zeros(len(error), bool)
    near[sphere.faces[sphere.pole[sphere.faces].any(1)]] = True
    row = found.loc["a", "gauss_bonnet", printed, "without-poles", "H"]
    assert row["mean"] == pytest.approx(error[~near].mean())
    assert (row.vertices, row.triangles) == ((~near).sum(), len(sphere.faces))
    row = found.loc["a", "gauss_bonnet", VARIANTS["default"][0], "interior", "H"]
    assert row.vertices == len(near)
    levels = found.rounding.groupby(["surface", "quantity"]).first()
    assert levels["a", "K"] == pytest.approx(ROUNDING / radius**2)
    assert levels["a", "H"] == pytest.approx(ROUNDING / radius)
    # A cylinder has no pole: both choices are the same.
    two = [
        found.loc["b", "taubin_a", "angles=one-sided", c, "H"][list(NORMS)]
        for c in ("interior", "without-poles")
    ]
    pd.testing.assert_series_equal(*two, check_names=False)
    assert found.loc["b"].undefined.gt(0).all()
