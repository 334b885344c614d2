"""The config: every mistake is one line that names its key, before anything runs."""

import os
from pathlib import Path

import pytest
import yaml

import curvlib
from curvlib.catalogue import estimators
from curvlib.claims.explanations import BEST
from curvlib.study.config import FOUND, Study

ROOT = Path(__file__).parents[2]
NINE = """
circular gauss_bonnet paraboloid taubin taubin_a taubin_b watanabe watanabe_a watanabe_b
"""
NUMBERS_AS_TEXT = "text: --config delivers no numbers, a file for --configfile does"

MISTAKES = [
    ("surfaces: [sphre]", "surfaces: unknown surface 'sphre'; did you mean 'sphere'?"),
    ("surfaces:", "surfaces has to be 'all', or a list of names and paths, not None"),
    ("surfaces: [3]", "surfaces has to be 'all', or a list of names and paths, not [3]"),
    ("estimators: [taubn]", "estimators: unknown estimator 'taubn'; did you mean 'taubin'?"),
    ("estimators: []", "estimators has to be 'all', or a list of names and paths, not []"),
    ("estimators: taubin", "estimators has to be 'all', or a list of names and paths"),
    ("estimators: [all, mine.py]", "estimators: estimator file 'mine.py' does not exist"),
    ("resolutions: [8, 2]", "resolutions: 2 has to be an integer of at least 3"),
    ("resolutions: [8.5]", "resolutions: 8.5 has to be an integer of at least 3"),
    ("resolutions: [true]", "resolutions: True has to be an integer of at least 3"),
    ("resolutions: 8", "resolutions has to be a list that is not empty"),
    ("resolutions: ['8', '12']", NUMBERS_AS_TEXT),
    ("resolutions: '[8, 12]'", NUMBERS_AS_TEXT),
    ("diagonals: [shortst]", "unknown diagonal 'shortst'; did you mean 'shortest'?"),
    ("diagonals: [same-1]", "a seed is a number, after random or jittered alone"),
    ("diagonals: same", "diagonals has to be a list"),
    ("reading: {}", "unknown key 'reading'; did you mean 'readings'?"),
    ("more: 3", "more has to be a list of diagonals with their resolutions, [] for none, not 3"),
    ("more:", "more has to be a list of diagonals with their resolutions, [] for none, not None"),
    ("more: [{diagonals: [same]}]", "has to be diagonals and resolutions, each a list"),
    ("more: [{diagonals: [same], resolutions: [2]}]", "more: resolutions: 2 has to be an integer"),
    ("more: [{diagonals: [sme], resolutions: [8]}]", "more: diagonals: unknown diagonal 'sme'"),
    ("readings: 3", "readings has to be names with choices"),
    ("readings: {default: {}, a: exact}", "readings: a has to be choices, option and value"),
    ("readings: {default: {}, a: {are: half}}", "unknown option 'are'; did you mean 'area'?"),
    (
        "readings: {default: {}, a: {area: halv}}",
        "reading 'a': unknown area 'halv'; did you mean 'half'?",
    ),
    ("readings: {default: {area: half}}", "default has to be {}, since it makes no choice"),
    ("readings: {default: {}, best-explanation: {}}", "is what the search finds; rename it"),
    ("readings: {a: {area: half}}", "readings has to be names with choices"),
    ("more_readings: [default, hlaf]", "unknown reading 'hlaf'; did you mean 'half'?"),
    ("more_readings: [half]", "more_readings has to be a list of readings, default among them"),
    ("more_readings: default", "more_readings has to be a list of readings"),
    ("vary:", "vary has to be a list of options, [] for none, not None"),
    ("vary: normal", "vary has to be a list of options, [] for none, not 'normal'"),
    ("vary: [pears]", "vary: unknown option 'pears'; did you mean 'pairs'?"),
    ("product:", "product has to be a list of options, [] for none, not None"),
    ("product: [aera]", "product: unknown option 'aera'; did you mean 'area'?"),
    ("library: 3", "library has to be the path of a folder or of a .zip file, not 3"),
    ("library:", "library has to be the path of a folder or of a .zip file, not None"),
    ("library: none.zip", "library: 'none.zip' does not exist"),
    ("results:", "results has to be the path of a folder, not None"),
    ("results: ''", "results has to be the path of a folder, not ''"),
    (f"results: {__file__}", "is not a folder"),
    ("results: 'a/{b}'", "results: 'a/{b}' has a brace"),
    ("results: ~no_user_of_this_name/a", "there is no such home folder"),
    ("library: ~no_user_of_this_name/a.zip", "there is no such home folder"),
    ("resolutions: [8, 100000]", "resolutions: resolution 100000 is more than 18918"),
    ("readings: {default: {}, a: {area: [half]}}", "unknown area ['half']; valid: third"),
]


@pytest.mark.parametrize(("text", "message"), MISTAKES, ids=[text for text, _ in MISTAKES])
def test_a_mistake_is_one_line(config, text, message):
    with pytest.raises(curvlib.InputError) as caught:
        Study(config | yaml.safe_load(text))
    assert str(caught.value).startswith("config: ")
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_every_key_is_needed(config):
    for key in config:
        with pytest.raises(curvlib.InputError, match=f"key '{key}' is missing"):
            Study({k: v for k, v in config.items() if k != key})


def test_a_folder_that_cannot_be_written_to(config, monkeypatch):
    assert str(Study(config).results) == config["results"]
    monkeypatch.setattr(os, "access", lambda path, mode: False)
    with pytest.raises(curvlib.InputError, match="cannot be written to"):
        Study(config)


def test_a_tilde_is_the_home_folder(config, monkeypatch, tmp_path):
    monkeypatch.setenv("HOME", str(tmp_path))
    (tmp_path / "mine.py").write_text("LABEL = 'Mine'\n\n\ndef estimate(mesh):\n    return None\n")
    study = Study(
        config | {"library": "~/lib", "results": "~/out", "estimators": ["taubin", "~/mine.py"]}
    )
    assert (study.library, study.results) == (tmp_path / "lib", tmp_path / "out")
    assert study.estimators == ["taubin", str(tmp_path / "mine.py")]


def test_all_alone_and_in_a_list(config, tmp_path):
    mine = tmp_path / "mine.py"
    mine.write_text("LABEL = 'Mine'\n\n\ndef estimate(mesh):\n    return None\n")
    assert Study(config | {"estimators": "all"}).estimators == curvlib.estimators()
    study = Study(config | {"estimators": ["all", str(mine), "taubin"], "surfaces": ["all"]})
    assert study.estimators == [*curvlib.estimators(), str(mine)]
    assert study.surfaces == curvlib.surfaces()


@pytest.mark.parametrize(
    ("key", "content"),
    [
        ("estimators", "def estimate(mesh):\n    return None\n"),
        ("surfaces", "def build():\n    return None\n"),
    ],
)
def test_two_files_of_one_stem_are_both_named(config, tmp_path, key, content):
    files = [tmp_path / folder / "mine.py" for folder in "ab"]
    for file in files:
        file.parent.mkdir()
        file.write_text(f"LABEL = 'Mine'\n\n\n{content}")
    paths = list(map(str, files))
    with pytest.raises(curvlib.InputError) as caught:
        Study(config | {key: paths})
    assert all(path in str(caught.value) for path in paths)


def test_an_estimator_and_a_surface_of_one_stem(config, tmp_path):
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
    (tmp_path / "a/mine.py").write_text("LABEL = 'A'\n\n\ndef estimate(mesh):\n    return None\n")
    (tmp_path / "b/mine.py").write_text("LABEL = 'B'\n\n\ndef build():\n    return None\n")
    both = {"estimators": [f"{tmp_path}/a/mine.py"], "surfaces": [f"{tmp_path}/b/mine.py"]}
    with pytest.raises(curvlib.InputError, match=r"two files are called 'mine': .*a/mine.*b/mine"):
        Study(config | both)


MINE = "\n\ndef estimate(ring):\n    pass\n"


def test_files_are_checked_when_the_study_is_read(config, tmp_path):
    mine = tmp_path / "mine.py"
    for key, text, message in (
        (
            "estimators",
            "LABEL = 'x'\n",
            "estimators: .*mine.py' has no estimate: it has to hold",
        ),
        ("estimators", "def estimate(ring):\n    pass\n", "mine.py' has no LABEL"),
        ("estimators", "LABEL = 'x'\nimport nonsens\n", "mine.py, line 2: ModuleNotFoundError"),
        ("estimators", "LABEL = 'x'\ndef estimate(ring, a):\n    pass\n", "'a' has no default"),
        ("estimators", "LABEL = 'x'\nestimate = 3\n", "estimate has to be a function, not 3"),
        ("estimators", f"LABEL = 3\n{MINE}", "LABEL has to be text, not 3"),
        ("estimators", f"LABEL, STYLE = 'x', 'red'\n{MINE}", "STYLE has to be a dict"),
        ("estimators", f"LABEL = 'x'\n{MINE}raise SystemExit(3)\n", "mine.py, line 6: SystemExit"),
        ("surfaces", "LABEL = 'x'\n", "surfaces: .*mine.py' has no build"),
        ("surfaces", "def build():\n    pass\n", "mine.py' has no LABEL"),
        ("surfaces", "LABEL = 'x\n", "mine.py, line 1: SyntaxError"),
    ):
        mine.write_text(text)
        with pytest.raises(curvlib.InputError, match=message) as caught:
            Study(config | {key: [str(mine)]})
        assert "\n" not in str(caught.value)


def test_the_study_names_what_it_runs():
    config = yaml.safe_load((ROOT / "config/config.yaml").read_text(encoding="utf-8"))
    assert " ".join(config["estimators"]) == NINE.strip()
    assert len(config["surfaces"]) == 10


def test_a_broken_file_that_the_study_does_not_name(config, monkeypatch):
    names = [*estimators.names(), "broken"]
    monkeypatch.setattr(estimators, "names", lambda: names)
    Study(config)
    with pytest.raises(curvlib.InputError, match="broken"):
        Study(config | {"estimators": "all"})


def test_an_overlay_cannot_overwrite_the_study(config):
    def study(changes):
        return Study(config | changes)

    assert study({}).is_that_of(config)
    assert study({"results": config["results"] + "/b"}).is_that_of(config)
    assert not study({"estimators": ["taubin"]}).is_that_of(config)
    with pytest.raises(curvlib.InputError, match="results: the tables of the study"):
        study({"estimators": ["taubin"]}).check_places(config)
    elsewhere = {"results": config["results"] + "/mine"}
    study({"estimators": ["taubin"]} | elsewhere).check_places(config)
    with pytest.raises(curvlib.InputError, match="library: the meshes of the study"):
        study({"resolutions": [8]} | elsewhere).check_places(config)
    elsewhere["library"] = config["library"] + "/mine"
    study({"resolutions": [8]} | elsewhere).check_places(config)


def test_meshes(config):
    assert Study(config).meshes() == [
        ("same", 8, True),
        ("same", 12, True),
        ("random-1", 8, True),
        ("random-1", 12, True),
        ("same", 64, False),
    ]


def test_the_name_of_what_the_search_finds_is_one():
    assert FOUND == BEST
