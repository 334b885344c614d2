"""The sources of the documentation; `make docs` builds it, with every reference checked."""

import ast
import re
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import curvlib
from curvlib.meshes.exchange import as_mesh
from curvlib.meshes.writing import write

ROOT = Path(__file__).parents[1]
PAGES = [
    *ROOT.glob("*.md"),
    *ROOT.glob("docs/*.md"),
    *ROOT.glob("docs/[!_g]*/*.md"),
    *ROOT.glob("docs/[!_g]*/*.rst"),
    *ROOT.glob("docs/gallery/*.py"),
]
PAGES = [path for path in PAGES if "examples" not in path.parts]
# Wrong or second spellings of the field's terms, and the one that is used.
SPELLINGS = {
    r"gausian|guassian|gauss curvature": "Gaussian",
    r"gauss[- ]?bonett|gauss-bonet": "Gauss-Bonnet",
    r"curvure|curvaure|curvture": "curvature",
    r"principle (curvature|direction)": "principal",
    r"parabaloid|paraboliod": "paraboloid",
    r"tesselat": "tessellation",
    r"triangularis": "triangulation",
    r"umbillic": "umbilic",
    r"vertexes": "vertices",
    r"neighbor": "neighbour",
    r"angle deficiency|angular defect|angular deficit": "angle defect",
    r"dihedreal|diedral": "dihedral",
    r"manifould|non manifold": "non-manifold",
    r"delauney|delaunai": "Delaunay",
    r"voronoy": "Voronoi",
    r"weingarden": "Weingarten",
    r"\bnurbs-surface|nurb surface": "NURBS surface",
    r"curvedness index": "curvedness",
    r"eigen-?vector of curvature": "principal direction",
}


def prose(path):
    """The text of a page without code."""
    text = path.read_text(encoding="utf-8")
    text = re.sub(r"^```.*?^```", "", text, flags=re.S | re.M)
    return re.sub(r"`[^`\n]*`", "", text)


def test_there_are_pages_to_look_at():
    assert {"README.md", "start.md", "api.rst", "plot_1_scan.py"} <= {path.name for path in PAGES}


@pytest.mark.parametrize("wrong", SPELLINGS)
def test_terms_of_the_field_are_spelt_in_one_way(wrong):
    for path in PAGES:
        found = re.search(wrong, prose(path), re.I)
        assert not found, f"{path.name}: {found[0]!r}; we write {SPELLINGS[wrong]}"


def test_links_between_files_lead_somewhere():
    """Those to pages that the build makes are checked by the build."""
    for path in PAGES:
        if path.suffix == ".md":
            for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", prose(path)):
                made = re.search(r"(^|/)(generated|examples)/", target)
                assert made or (path.parent / target).exists(), f"{path.name}: {target}"


def test_examples_that_pages_link_to_are_there():
    for path in PAGES:
        if path.suffix == ".md":
            for name in re.findall(r"examples/(plot_\w+)\.rst", path.read_text(encoding="utf-8")):
                assert (ROOT / f"docs/gallery/{name}.py").exists(), f"{path.name}: {name}"


def test_pictures_have_words():
    for path in PAGES:
        text = path.read_text(encoding="utf-8")
        assert "![](" not in text, path.name
        for options in re.findall(r"(?:\{image\}|image::|figure::).*\n((?: *:.*\n)*)", text):
            assert re.search(r":alt: .{20,}", options), path.name


def test_every_public_name_has_its_place_in_the_reference():
    text = (ROOT / "docs/reference/api.rst").read_text(encoding="utf-8")
    for name in curvlib.__all__:
        assert re.search(rf"(::| ) {name}(\(\))?$", text, re.M), name


@pytest.mark.parametrize(
    "script", sorted(ROOT.glob("docs/gallery/*.py")), ids=lambda path: path.stem
)
def test_examples_have_a_title_and_words(script):
    """What the gallery makes a page of; the build runs them."""
    title, rule, *words = ast.get_docstring(ast.parse(script.read_text("utf-8"))).splitlines()
    assert rule == "=" * len(title)
    assert len(" ".join(words)) > 100


def test_the_reader_in_cpp_reads_what_is_written(tmp_path):
    compiler = shutil.which("c++")
    if not compiler:
        pytest.skip("there is no C++ compiler")
    page = (ROOT / "docs/pipelines/cpp.md").read_text(encoding="utf-8")
    source = tmp_path / "read_values.cpp"
    source.write_text(re.search(r"```c\+\+\n(.*?)```", page, re.S)[1], encoding="utf-8")
    mesh = as_mesh(([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))
    named = {"K": np.array([5.0, 6.0, 7.0]), "H": np.array([1.0, np.nan, 2.5])}
    write(tmp_path / "values.ply", mesh, named)
    subprocess.run([compiler, "-o", tmp_path / "read", source], check=True)
    told = subprocess.run([tmp_path / "read", tmp_path / "values.ply"], capture_output=True)
    assert told.stdout == b"2 vertices, mean H 1.75\n"
