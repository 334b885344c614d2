"""What the package says of itself; `make wheel` builds it, and tries it in empty environments."""

import json
import re
import tomllib
from pathlib import Path

import yaml

import curvlib

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]


def test_core_dependencies_are_few_and_bounded_below_alone():
    assert len(PROJECT["dependencies"]) <= 6
    for requirement in PROJECT["dependencies"]:
        assert re.fullmatch(r"[a-z0-9]+>=[0-9.]+", requirement), requirement


def test_extras_have_no_upper_bounds():
    for extra, requirements in PROJECT["optional-dependencies"].items():
        for requirement in requirements:
            assert not re.search("<|~=|==|!=", requirement), extra


def test_classifiers_begin_with_the_python_that_is_required():
    claimed = re.findall(r"Python :: (3\.\d+)", "\n".join(PROJECT["classifiers"]))
    assert PROJECT["requires-python"] == f">={claimed[0]}"
    assert claimed == sorted(claimed, key=lambda version: int(version.split(".")[1]))


def test_addresses_are_marked_as_placeholders():
    """`.example` is reserved: no such address exists or ever will."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    assert re.search(r"# Placeholders.*\n\[project\.urls\]", text)
    for address in PROJECT["urls"].values():
        assert address.startswith("https://curvlib.example/"), address


def test_licences_tell_of_data_in_the_package():
    told = (ROOT / "LICENSE-third-party").read_text(encoding="utf-8")
    for path in sorted((ROOT / "curvlib").rglob("*")):
        if path.suffix in (".csv", ".json", ".npz", ".npy", ".cpp", ".txt"):
            assert path.relative_to(ROOT).as_posix() in told, path


def test_what_archives_are_told_is_what_the_citation_says():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    told = json.loads((ROOT / ".zenodo.json").read_text(encoding="utf-8"))
    assert told["version"] == citation["version"] == curvlib.__version__
    assert told["publication_date"] == str(citation["date-released"])
    assert told["title"] == citation["title"]
    assert told["creators"] == citation["authors"]
    assert told["license"] == citation["license"][0]
    (paper,) = citation["references"]
    assert told["related_identifiers"][0]["identifier"] == paper["doi"]
    changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    assert f"## {citation['version']} ({citation['date-released']})" in changes
