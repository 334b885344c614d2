"""Files of strangers: read as they are now, checked, blamed by line."""

import os
import re

import numpy as np
import pytest

from curvlib.catalogue import COLOURS, MARKERS, Catalogue, estimators
from curvlib.errors import InputError


@pytest.fixture
def catalogue():
    return Catalogue("estimator", "estimators", "estimate")


def write(path, value, time, label="LABEL = 'Mine'"):
    path.write_text(f"{label}\n\n\ndef estimate(ring):\n    return {value}\n")
    os.utime(path, ns=(time, time))


def test_an_edited_file_is_read_again(catalogue, tmp_path):
    """Within the same second too, for which a .pyc would be taken as current."""
    mine = tmp_path / "mine.py"
    write(mine, 1, 10**18)
    first = catalogue.module(str(mine))
    assert first.estimate(None) == 1
    assert catalogue.module(str(mine)) is first
    write(mine, 2, 10**18 + 1)
    assert catalogue.module(str(mine)).estimate(None) == 2
    mine.unlink()
    with pytest.raises(InputError, match="does not exist"):
        catalogue.module(str(mine))


def test_a_relative_path_is_that_of_the_working_directory(catalogue, tmp_path, monkeypatch):
    for number, folder in enumerate("ab"):
        (tmp_path / folder).mkdir()
        write(tmp_path / folder / "mine.py", number, 10**18)
        monkeypatch.chdir(tmp_path / folder)
        assert catalogue.module("mine.py").estimate(None) == number


def test_a_mended_file_is_read_again(catalogue, tmp_path):
    mine = tmp_path / "mine.py"
    mine.write_text("def estimate(ring)\n    pass\n")
    for _ in range(2):
        with pytest.raises(InputError, match=r"mine.py, line 1: SyntaxError: expected ':'"):
            catalogue.module(str(mine))
    write(mine, 1, 10**18)
    assert catalogue.module(str(mine)).estimate(None) == 1


def test_compiled_code_is_blamed_by_line(tmp_path):
    mine = tmp_path / "mine.py"
    mine.write_text(
        "from curvlib.kit.compiled import compiled\n\n\n@compiled\ndef estimate(ring):\n"
        "    if ring > 1:\n        raise ValueError('too large')\n    return ring.nonsense, None\n"
    )
    estimate = estimators.module(str(mine)).estimate
    with pytest.raises(Exception, match="nonsense") as caught:
        estimate(1.0)
    told = str(estimators.told(caught.value))
    assert told == (
        f"estimator {mine}, line 8: TypingError: Unknown attribute 'nonsense' of type float64"
    )
    mine.write_text(mine.read_text().replace("ring.nonsense", "ring"))
    with pytest.raises(ValueError, match="too large") as caught:
        estimators.module(str(mine)).estimate(2.0)
    assert str(estimators.told(caught.value)) == f"estimator {mine}, line 7: ValueError: too large"


def test_a_fault_elsewhere_is_blamed_on_no_file(catalogue):
    catalogue.module("gauss_bonnet")
    with pytest.raises(KeyError) as caught:
        {}["x"]
    assert catalogue.told(caught.value) is None


def test_no_nearest_name_for_what_is_no_text(catalogue):
    for name in (3, None, ["gauss_bonnet"], np.array(["gauss_bonnet"])):
        with pytest.raises(InputError, match=f"unknown estimator {re.escape(repr(name))}; valid: "):
            catalogue.module(name)


def test_styles(catalogue, tmp_path):
    package = list(catalogue.modules({n: n for n in catalogue.names()}).values())
    assert not {module.STYLE["color"] for module in package} & set(COLOURS)
    assert not {module.STYLE["marker"] for module in package} & set(MARKERS)
    files = {}
    for number in range(60):
        files[number] = str(tmp_path / f"mine{number}.py")
        write(tmp_path / f"mine{number}.py", number, 10**18)
    given = [str(sorted(module.STYLE.items())) for module in catalogue.modules(files).values()]
    assert len(set(given)) == 60
    for number in (0, 1):
        style = "LABEL, STYLE = 'x', {'color': 'red'}"
        write(tmp_path / f"mine{number}.py", number, 10**18 + 1, style)
    with pytest.raises(InputError, match=r"mine0.py and .*mine1.py have one STYLE"):
        catalogue.modules(files)
