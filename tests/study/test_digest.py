"""Digests: they change with what a result depends on, and with nothing else."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import curvlib
from curvlib.study.digest import digest

PACKAGE = Path(curvlib.__file__).parent


@pytest.fixture
def package(monkeypatch, tmp_path):
    copy = shutil.copytree(PACKAGE, tmp_path / "curvlib")
    monkeypatch.setattr("curvlib.study.digest.PACKAGE", copy)
    return copy


def change(path, old, new):
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), encoding="utf-8")


def test_follows_imports_but_not_comments(package):
    variant, parent = package / "estimators/taubin_a.py", package / "estimators/taubin.py"
    before, kept = digest(variant), parent.read_text()
    assert digest(PACKAGE / "estimators/taubin_a.py") == before
    parent.write_text(kept + "\n# a comment\n")
    assert digest(variant) == before
    parent.write_text(kept.replace('"""Taubin', '"""Not Taubin'))
    assert digest(variant) == before
    parent.write_text(kept + "\nX = 1\n")
    assert digest(variant) != before
    assert digest(package / "estimators/watanabe_b.py") != before


@pytest.mark.parametrize(
    "line",
    [
        "from curvlib.kit.fit import solve",
        "from curvlib.kit import fit",
        "import curvlib.kit.fit",
        "import math, curvlib.kit.fit as f",
        "def estimate(ring):\n    from curvlib.kit import fit",
    ],
)
def test_every_way_to_import(package, tmp_path, line):
    mine = tmp_path / "mine.py"
    mine.write_text(line)
    before = digest(mine)
    fit = package / "kit/fit.py"
    fit.write_text(fit.read_text() + "\nX = 1\n")
    assert digest(mine) != before


def test_an_import_for_annotations_alone_is_not_followed(package, tmp_path):
    mine = tmp_path / "mine.py"
    top = "import typing\nfrom typing import TYPE_CHECKING\n"
    for test in ("TYPE_CHECKING", "typing.TYPE_CHECKING"):
        mine.write_text(f"{top}if {test}:\n    from curvlib.kit import fit\nelse:\n    X = 1\n")
        before = digest(mine)
        change(package / "kit/fit.py", "def ", "X = 1\n\n\ndef ")
        assert digest(mine) == before
        change(mine, "X = 1", "X = 2")
        assert digest(mine) != before


def test_a_rooms_docstring_ties_nothing(package):
    before = digest(package / "estimators/taubin_a.py", package / "surfaces/ellipsoid.py")
    for room in ("estimators", "kit", "surfaces", "nurbs"):
        (package / room / "__init__.py").write_text("X = 1\n")
    assert digest(package / "estimators/taubin_a.py", package / "surfaces/ellipsoid.py") == before


def test_a_control_point_of_the_teapot(package):
    before = digest(package / "surfaces/teapot_spout.py")
    net = package / "surfaces/teapot.json"
    change(net, "1.7", "1.8")
    assert digest(package / "surfaces/teapot_spout.py") != before


def test_a_data_file_beside_a_strangers_surface(tmp_path):
    mine = tmp_path / "mine.py"
    mine.write_text('from pathlib import Path\nNET = Path(__file__).with_name("net.csv")\n')
    (tmp_path / "net.csv").write_bytes(b"1 2 3\xff")
    before = digest(mine)
    (tmp_path / "net.csv").write_bytes(b"1 2 4\xff")
    assert digest(mine) != before
    (tmp_path / "net.csv").write_bytes(b"1 2 3\xff")
    assert digest(mine) == before
    (tmp_path / "other.csv").write_text("not named")
    assert digest(mine) == before


def test_a_file_of_the_system_is_no_data(tmp_path):
    """/proc/self/status has other bytes each time."""
    mine = tmp_path / "mine.py"
    mine.write_text('X = open("/proc/self/status"), open("../net.csv")\n')
    (tmp_path.parent / "net.csv").write_text("1")
    before = digest(mine)
    (tmp_path.parent / "net.csv").write_text("2")
    assert digest(mine) == before


def test_is_the_same_in_a_locale_without_utf_8():
    code = "import sys; from curvlib.study.digest import digest; print(digest(*sys.argv[1:]))"
    command = [sys.executable, "-c", code, *map(str, PACKAGE.rglob("*.py"))]
    ascii_only = {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    found = {
        subprocess.run(
            command, capture_output=True, text=True, check=True, env=os.environ | environment
        ).stdout
        for environment in ({"PYTHONUTF8": "1"}, ascii_only)
    }
    assert len(found) == 1
