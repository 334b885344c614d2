"""Options in compiled code: as in Python, without a comparison of strings."""

import numpy as np
import pytest

import curvlib
from curvlib.kit.compiled import compiled
from curvlib.kit.options import Length, Option
from curvlib.meshes.torus import torus


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


def lengths(disk, radius: Length = None):
    return disk.radius, radius


def test_lengths():
    """A number in the mesh's unit, or mean edges; compiled once for any of them."""
    vertices, faces = torus(16, "irregular")
    mesh = curvlib.Mesh(vertices, faces)
    edge = mesh.mean_edge
    for value, expected in ((0.9, 0.9), (1, 1), ("2 edges", 2 * edge), ("1.5 edges", 1.5 * edge)):
        reached, given = curvlib.estimate(mesh, lengths, radius=value)
        np.testing.assert_allclose(given, expected, rtol=1e-15)
        assert 0.5 * expected < reached.min() < reached.max() <= expected * (1 + 1e-15)
    one_ring = curvlib.estimate(mesh, lengths)
    assert np.isnan(one_ring.H).all()  # infinite


@pytest.mark.parametrize(
    "value", ["5", "5 rings", "-1 edges", "1.2.3 edges", 0, -1, True, [1], 1e999, 10**400]
)
def test_what_is_no_length(value):
    mesh = torus(8, "regular")
    with pytest.raises(
        curvlib.InputError, match=r"radius of lengths: .* is no length; valid: a posi"
    ):
        curvlib.estimate(mesh, lengths, radius=value)
