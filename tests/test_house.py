"""The house itself: what imports what, what an import costs, what changes a digest."""

import ast
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import curvlib
from curvlib.study.config import Study
from curvlib.study.digest import digest

PACKAGE = Path(curvlib.__file__).parent

# Each room and the others that it imports: exactly these, so that a door nothing uses goes.
DOORS = {
    "__init__": {"catalogue", "estimators", "surfaces"},
    "errors": set(),
    "parallel": set(),
    "files": {"errors"},
    "catalogue": {"errors"},
    "kit": {"errors"},
    "estimators": {"kit"},
    "meshes": {"errors", "kit", "parallel"},
    "nurbs": {"errors", "kit", "meshes"},
    "surfaces": {"catalogue", "errors", "nurbs"},
    "estimates": {"errors", "kit"},
    "estimation": {"catalogue", "errors", "estimates", "kit", "meshes", "parallel"},
    "dataset": {"errors", "files", "meshes", "nurbs"},
    "comparison": {"catalogue", "estimation", "files", "kit", "meshes", "surfaces"},
    "claims": {"comparison"},
    "figures": {"comparison", "errors", "files"},
    "study": {"catalogue", "comparison", "errors", "estimation", "files", "nurbs"},
    "commands": {"dataset", "errors", "__version__"},
}


def imported(path):
    """The rooms of curvlib that a file imports from, its own left out."""
    parts = path.relative_to(PACKAGE).with_suffix("").parts
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom):
            full = ["curvlib", *parts[: len(parts) - node.level]] if node.level else []
            full += (node.module or "").split(".") if node.module else []
            if full[:1] == ["curvlib"]:
                rooms = [full[1]] if full[1:] else [alias.name for alias in node.names]
                yield from (room for room in rooms if room != parts[0])


def test_doors_between_rooms():
    found = {}
    for path in PACKAGE.rglob("*.py"):
        room = path.relative_to(PACKAGE).with_suffix("").parts[0]
        found.setdefault(room, set()).update(imported(path))
    assert found == DOORS


def test_two_levels_and_rooms_that_open_with_one_docstring():
    for path in PACKAGE.rglob("*.py"):
        assert len(path.relative_to(PACKAGE).parts) <= 2, path
        if path.name == "__init__.py" and path.parent != PACKAGE:
            (docstring,) = ast.parse(path.read_text(encoding="utf-8")).body
            assert isinstance(docstring.value, ast.Constant), path


def test_an_import_brings_nothing_heavy():
    heavy = "numba scipy pandas matplotlib pyvista h5py pooch snakemake"
    code = f"import sys, curvlib; print([m for m in '{heavy}'.split() if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_listings_stay_callable_after_their_packages_are_used():
    curvlib.estimate(curvlib.tessellate(curvlib.surface("cone"), 4), "taubin_a")
    assert "cone" in curvlib.surfaces()
    assert "taubin_a" in curvlib.estimators()


def test_digest_follows_imports_but_not_comments(monkeypatch, tmp_path):
    copy = shutil.copytree(PACKAGE, tmp_path / "curvlib")
    monkeypatch.setattr("curvlib.study.digest.PACKAGE", copy)
    variant, parent = copy / "estimators/taubin_a.py", copy / "estimators/taubin.py"
    before, kept = digest(variant), parent.read_text()
    assert digest(PACKAGE / "estimators/taubin_a.py") == before
    parent.write_text(kept + "\n# a comment\n")
    assert digest(variant) == before
    parent.write_text(kept.replace('"""Taubin', '"""Not Taubin'))
    assert digest(variant) == before
    parent.write_text(kept + "\nX = 1\n")
    assert digest(variant) != before
    assert digest(copy / "estimators/watanabe_b.py") != before


@pytest.fixture
def config(tmp_path):
    return {
        "surfaces": ["sphere"],
        "estimators": ["gauss_bonnet", "watanabe_b", "watanabe"],
        "resolutions": [12, 8, 8],
        "diagonals": ["same", "random-1"],
        "more": [{"diagonals": ["same"], "resolutions": [12, 64]}],
        "readings": {"default": {}, "half": {"area": "half"}},
        "more_readings": ["default", "half"],
        "vary": ["area", "normal", "vertices"],
        "product": ["area", "dihedral"],
        "library": str(tmp_path),
        "results": str(tmp_path),
    }


def test_a_folder_that_cannot_be_written_to(config, monkeypatch):
    assert str(Study(config).results) == config["results"]
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    with pytest.raises(curvlib.InputError, match="cannot be written to"):
        Study(config)


def test_readings_of_more_meshes(config):
    study = Study(config)
    assert study.more_variants("gauss_bonnet") == [
        "area=third,dihedral=signed",
        "area=half,dihedral=signed",
    ]
    assert study.more_variants("watanabe_b") == ["normal=uniform"]
    for wrong, message in (
        (["default", "hlaf"], "did you mean 'half'"),
        (["half"], "has to hold 'default'"),
        ("default", "has to be a list"),
    ):
        with pytest.raises(curvlib.InputError, match=message):
            Study(config | {"more_readings": wrong})


def test_products_that_have_a_name(config):
    named = {"area=third,dihedral=signed": "default", "area=half,dihedral=signed": "half"}
    assert Study(config).named_products() == named
    other = {"readings": config["readings"] | {"principal": {"principal": "as-printed"}}}
    assert Study(config | other).named_products() == named
    assert Study(config | {"product": []}).named_products() == {}


def test_study_shares_what_readings_have_in_common(config):
    study = Study(config)
    assert study.meshes() == [
        ("same", 8, True),
        ("same", 12, True),
        ("random-1", 8, True),
        ("random-1", 12, True),
        ("same", 64, False),
    ]
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
