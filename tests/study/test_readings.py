"""Readings: what each means for each estimator, and which are the same."""

import pytest

from curvlib.study.config import Study
from curvlib.study.readings import error_figures


def test_readings_of_more_meshes(config):
    study = Study(config)
    assert study.more_variants("gauss_bonnet") == [
        "area=third,dihedral=signed",
        "area=half,dihedral=signed",
    ]
    assert study.more_variants("watanabe_b") == ["normal=uniform"]


def test_products_that_have_a_name(config):
    named = {"area=third,dihedral=signed": "default", "area=half,dihedral=signed": "half"}
    assert Study(config).named_products() == named
    other = {"readings": config["readings"] | {"principal": {"principal": "as-printed"}}}
    taubin = {"estimators": [*config["estimators"], "taubin"]}
    assert Study(config | other | taubin).named_products() == named
    assert Study(config | {"product": []}).named_products() == {}


def test_a_product_that_changes_some_estimator_is_not_the_default(config):
    """`uniform` is the default of all but watanabe, which weighs by area: no value of `normal`
    leaves both kinds as they are, unless only one kind is there."""
    product = {"product": ["normal"]}
    assert Study(config | product).named_products() == {}
    one_kind = config | product | {"estimators": ["watanabe"], "readings": {"default": {}}}
    one_kind["more_readings"] = ["default"]
    assert Study(one_kind).named_products() == {"normal=area": "default"}
    exact = {"readings": config["readings"] | {"exact": {"normal": "exact"}}}
    assert Study(config | product | exact).named_products() == {"normal=exact": "exact"}


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
    assert set(study.choices()) == {"normal", "vertices"}
    # Options of others may stand in the config, whose readings an overlay can but add to.
    assert study.products() == {}
    assert all(not name.startswith("area") for name in study.single_changes())


def test_rows_say_what_each_reading_means(config):
    study = Study(config)
    rows = study.rows()
    of_all = {"kind": "named", "counted": "interior", "more": True}
    assert rows[:2] == [
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
