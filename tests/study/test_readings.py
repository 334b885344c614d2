"""Readings: what each means for each estimator, and which are the same."""

import pytest

from curvlib.errors import InputError
from curvlib.study.config import Study
from curvlib.study.readings import error_figures


def test_readings_of_more_meshes(config):
    study = Study(config)
    assert study.tabulated("gauss_bonnet", study.more_readings) == [
        "area=third,dihedral=signed",
        "area=half,dihedral=signed",
    ]
    assert study.tabulated("watanabe_b", study.more_readings) == ["normal=uniform"]
    # Those of products alone are not tabulated.
    assert len(study.tabulated("gauss_bonnet")) == 3
    assert len(study.variants("gauss_bonnet")) == 9


def test_an_option_of_one_estimator_goes_before_that_of_all(config):
    product = {"product": ["normal", "watanabe_b_normal"]}
    study = Study(config | product)
    products = study.products()
    assert len(products) == 9
    chosen = products["normal=area,watanabe_b_normal=exact"]
    assert study.options("watanabe_b", chosen) == {"normal": "exact"}
    assert study.options("watanabe", chosen)["normal"] == "area"
    with pytest.raises(InputError, match="unknown option 'watanabe_normals'; did you mean"):
        Study(config | {"product": ["watanabe_normals"]})


def test_the_first_values_of_a_product_are_the_default_reading(config):
    """`uniform`, the first of `normal`, leaves watanabe its own weights by area."""
    study = Study(config | {"product": ["normal", "area", "dihedral"]})
    first = next(iter(study.products()))
    assert first == "normal=uniform,area=third,dihedral=signed"
    for estimator in study.estimators:
        default = study.options(estimator, {})
        assert study.options(estimator, study.products()[first]) == default
    exact = study.products()["normal=exact,area=third,dihedral=signed"]
    assert study.options("watanabe", exact)["normal"] == "exact"


def test_study_shares_what_readings_have_in_common(config):
    study = Study(config)
    assert list(study.single_changes()) == [
        "area=half",
        "area=mixed",
        "normal=uniform",
        "normal=area",
        "normal=exact",
        "vertices=without-poles",
    ]
    assert len(study.products()) == 9
    assert next(iter(study.variants("gauss_bonnet"))) == "area=third,dihedral=signed"
    assert len(study.variants("gauss_bonnet")) == 9
    assert list(study.variants("watanabe_b")) == ["normal=uniform", "normal=area", "normal=exact"]
    # The value `area` is an option of one and the name of another's: no mix-up.
    assert study.options("watanabe", {"area": "half"}) == study.options("watanabe", {})


def test_choices_are_those_of_the_study_alone(config):
    study = Study(config | {"estimators": ["watanabe_b"]})
    assert set(study.choices()) == {"normal", "watanabe_b_normal", "vertices"}
    # Options of others may stand in the config, whose readings an overlay can but add to.
    assert study.products() == {}
    assert all(not name.startswith("area") for name in study.single_changes())


def test_rows_say_what_each_reading_means(config):
    study = Study(config)
    rows = study.rows()
    of_all = {"kind": "named", "counted": "interior", "more": True}
    assert list(rows[:2]) == [
        {
            "reading": "default",
            "estimator": "gauss_bonnet",
            "variant": "area=third,dihedral=signed",
            **of_all,
        },
        {"reading": "default", "estimator": "watanabe_b", "variant": "normal=uniform", **of_all},
    ]
    kinds = {row["reading"]: row["kind"] for row in rows}
    assert kinds["half"] == "named"
    assert kinds["area=half"] == "single"
    assert kinds["area=half,dihedral=signed"] == "product"
    (without_poles,) = {
        (row["counted"], row["more"]) for row in rows if row["reading"].startswith("vertices=")
    }
    assert without_poles == ("without-poles", False)


def test_parameters_of_jobs_are_short_in_the_report(config):
    rows = Study(config).rows()
    assert len(repr(rows)) < 40
    assert repr(rows) == repr(Study(config).rows())
    assert repr(rows) != repr(Study(config | {"product": []}).rows())
    assert len(repr(Study(config).products())) < 40


@pytest.mark.parametrize("quantity", "KH")
def test_error_figures(config, quantity):
    figures = error_figures(Study(config | {"surfaces": ["sphere", "revolution"]}), quantity)
    paper = {"K": "figure-3", "H": "figure-4"}[quantity]
    assert figures == {
        f"error-{quantity}-sphere": ("sphere", [8, 12, 64]),
        f"error-{quantity}-revolution": ("revolution", [8, 12, 64]),
        paper: ("revolution", [8, 12]),
    }


def test_curves_on_rings_are_those_that_the_study_runs(config):
    assert [label for *_, label in Study(config).ring_curves()] == ["Gauss-Bonnet"]
    both = Study(config | {"estimators": ["gauss_bonnet", "paraboloid"]}).ring_curves()
    assert both == [
        ("gauss_bonnet", "area=third,dihedral=signed", "Gauss-Bonnet"),
        ("paraboloid", "normal=uniform", "Paraboloid, estimated normals"),
        ("paraboloid", "normal=exact", "Paraboloid, exact normals"),
    ]


def test_an_option_may_be_searched_and_changed_alone(config):
    """Both have the name `normal=uniform`, which for watanabe means two things."""
    study = Study(config | {"product": ["normal"], "vary": ["normal"]})
    rows = [row for row in study.rows() if row["reading"] == "normal=uniform"]
    of_watanabe = {row["kind"]: row["variant"] for row in rows if row["estimator"] == "watanabe"}
    assert "normal=uniform" in of_watanabe["single"]
    assert "normal=area" in of_watanabe["product"]
    products = {row["reading"] for row in study.rows() if row["kind"] == "product"}
    assert len(products) == 3
