"""A job is run again for the code that it uses, and for no other."""

import shutil
from pathlib import Path

import pytest

import curvlib
from curvlib.study.digest import digest

PACKAGE = Path(curvlib.__file__).parent
SCRIPTS = PACKAGE.parent / "workflow/scripts"

GEOMETRY = ["nurbs/exact", "nurbs/surface", "nurbs/tessellation", "surfaces/_shapes"]
WRITING = ["dataset/formats", "dataset/write"]
ESTIMATES = ["estimation", "meshes/mesh", "meshes/corners", "kit/ring"]
TABLES = ["comparison/norms", "comparison/quantities"]


@pytest.mark.parametrize(
    ("script", "used", "others"),
    [
        ("estimate", [*ESTIMATES, *TABLES, "dataset/library"], [*GEOMETRY, *WRITING]),
        ("accuracy", [*TABLES, "comparison/accuracy"], [*GEOMETRY, *WRITING, *ESTIMATES]),
        (
            "shapes",
            [*ESTIMATES, *GEOMETRY, *TABLES, "comparison/shapes", "surfaces/_random"],
            [*WRITING, "comparison/accuracy", "comparison/trials", "surfaces/teapot_body"],
        ),
        (
            "claims",
            [*TABLES, "claims/evidence", "claims/sentences"],
            [*GEOMETRY, *WRITING, *ESTIMATES, "comparison/accuracy", "comparison/run"],
        ),
        (
            "claim_plots",
            ["claims/summary", "figures/style", "comparison/quantities"],
            [*GEOMETRY, *WRITING, *ESTIMATES, "comparison/run", "figures/pictures"],
        ),
    ],
)
def test_a_change_of_code_reaches_who_uses_it(monkeypatch, tmp_path, script, used, others):
    copy = shutil.copytree(PACKAGE, tmp_path / "curvlib")
    monkeypatch.setattr("curvlib.study.digest.PACKAGE", copy)

    def changes(name):
        path = copy / f"{name}.py"
        kept = path.read_text(encoding="utf-8")
        before = digest(SCRIPTS / f"{script}.py")
        path.write_text(kept + "\nX = 1\n", encoding="utf-8")
        changed = digest(SCRIPTS / f"{script}.py") != before
        path.write_text(kept, encoding="utf-8")
        return changed

    assert [name for name in used if not changes(name)] == []
    assert [name for name in others if changes(name)] == []
