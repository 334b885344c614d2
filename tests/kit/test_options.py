"""Options in compiled code: as in Python, without a comparison of strings."""

import pytest

from curvlib.kit.compiled import compiled
from curvlib.kit.options import Option


@compiled
def which(option):
    if option == "area":
        return 1
    return 2 if option == "" else 3


@pytest.mark.parametrize(("text", "number"), [("area", 1), ("", 2), ("Area", 3), ("exact", 3)])
def test_compared_with_literals(text, number):
    assert which(Option(text)) == number
    assert (Option(text) == "area") == (text == "area")
    assert which(text) == number  # a plain string does as well, compiled in more time


def test_numbers_are_the_same_in_every_process():
    """Compiled code that holds them is kept: the first seven bytes of SHA-256."""
    assert Option("area").number == 0x4A91EE5F0106C2
