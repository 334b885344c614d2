"""What is refused, in words that name what and where."""

import re

import numpy as np
import pytest
from geomdl import NURBS, BSpline, utilities

import curvlib

SQUARE = [[x, y, x * y] for x in (0.0, 1.0) for y in (0.0, 1.0)]


def bilinear(model, net):
    model.degree_u = model.degree_v = 1
    model.set_ctrlpts(net, 2, 2)
    model.knotvector_u = model.knotvector_v = [0, 0, 1, 1]
    return model


@pytest.mark.parametrize("bad", [(1.5, 0.5), (-0.1, 0.5), (np.nan, 0.5)])
def test_outside_the_domain(bad):
    with pytest.raises(
        curvlib.InputError, match=r"u = .* outside the domain \[0\.0, 1\.0\].*'sphere'"
    ):
        curvlib.surface("sphere").curvature(*bad)


def test_shapes_broadcast():
    s = curvlib.surface("sphere")
    c = s.curvature(np.zeros((4, 1)), np.zeros(3) + 0.3)
    assert c.K.shape == c.smooth.shape == (4, 3)
    assert c.normal.shape == s.point(np.zeros((4, 1)), np.zeros(3)).shape == (4, 3, 3)
    assert s.curvature(0.1, 0.2).K.shape == ()


def test_unknown_surface_names_the_nearest():
    with pytest.raises(curvlib.InputError, match="unknown surface 'sphre'; did you mean 'sphere'"):
        curvlib.surface("sphre")


@pytest.mark.parametrize(
    ("u", "v", "message"),
    [
        ([0.1, 0.2, 0.3], [0.1, 0.2], r"u and v of shapes \(3,\) and \(2,\) do not broadcast"),
        ("a", 0.5, "u: 'a' is not a number"),
        (0.5, ["0.1", "0.2"], "v: .* is not a number"),
        ([0.1, [0.2, 0.3]], 0.5, "u: .* is not a number"),
        (10**400, 0.5, "u: 10+.* is not a number"),
        (0.5j, 0.5, "u: 0.5j is not a number"),
        (None, 0.5, "u = nan lies outside"),
    ],
)
def test_parameters_that_are_none(u, v, message):
    s = curvlib.surface("sphere")
    for function in (s.point, s.normal, s.curvature):
        with pytest.raises(curvlib.InputError, match=message):
            function(u, v)


def test_parameters_within_rounding_of_the_end_are_the_end(build):
    """7 * 0.1 is more than 0.7; a message shows the digits in which numbers differ."""
    x, y = np.meshgrid(np.arange(7.0), np.arange(7.0), indexing="ij")
    knots = [k / 10 for k in range(11)]
    s = build((3, 3), (knots, knots), np.stack((x, y, x * y / 10), -1))
    assert 7 * 0.1 > s.domain[0][1]
    np.testing.assert_array_equal(s.point(7 * 0.1, 0.5), s.point(0.7, 0.5))
    assert s.curvature(7 * 0.1, 0.5).K == s.curvature(0.7, 0.5).K
    with pytest.raises(curvlib.InputError) as error:
        s.point(0.7 + 1e-12, 0.5)
    value, low, high = map(float, re.findall(r"\d\.\d+", str(error.value)))
    assert (low, high) == s.domain[0]
    assert value == 0.7 + 1e-12


def test_a_surface_without_weights_has_weights_of_one():
    """K = -1 / (1 + x^2 + y^2)^2 of z = x y."""
    u, v = np.linspace(0, 1, 9), np.linspace(0, 1, 7)[:, None]
    plain = curvlib.Surface(bilinear(BSpline.Surface(), SQUARE)).curvature(u, v)
    rational = curvlib.Surface(bilinear(NURBS.Surface(), [[*p, 1.0] for p in SQUARE]))
    np.testing.assert_array_equal(plain.K, rational.curvature(u, v).K)
    np.testing.assert_allclose(plain.K, -1 / (1 + u**2 + v**2) ** 2, rtol=1e-13)


def trimmed():
    model = bilinear(BSpline.Surface(), SQUARE)
    hole = BSpline.Curve()
    hole.degree = 1
    hole.ctrlpts = [[0.2, 0.2], [0.8, 0.2], [0.5, 0.8], [0.2, 0.2]]
    hole.knotvector = utilities.generate_knot_vector(1, 4)
    model.trims = [hole]
    return model


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: None, "a geomdl surface is needed, not NoneType"),
        (BSpline.Curve, "a geomdl surface is needed, not Curve"),
        (BSpline.Surface, "control points or knots are not set"),
        (trimmed, "trimmed surfaces are not supported"),
        (lambda: bilinear(NURBS.Surface(), [[*p, p[0] - 0.5] for p in SQUARE]), "weight is -0.5"),
        (lambda: bilinear(BSpline.Surface(), [*SQUARE[:3], [1, 1, np.nan]]), "is not finite"),
        (lambda: bilinear(BSpline.Surface(), [p[:2] for p in SQUARE]), "dimension 2"),
        (lambda: bilinear(BSpline.Surface(), [SQUARE[0]] * 4), "size 0"),
        (lambda: bilinear(BSpline.Surface(), np.add(SQUARE, 1e12).tolist()), "to the origin"),
    ],
)
def test_models_that_are_refused(make, message):
    with pytest.raises(curvlib.InputError, match=f"surface 'mine'.*{message}"):
        curvlib.Surface(make(), "mine")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("LABEL = 'Mine'\n", "has no build: it has to hold"),
        ("def build():\n    return None\n", "has no LABEL: it has to hold"),
        ("LABEL = 'Mine'\ndef build(n):\n    pass\n", "build: missing a required argument: 'n'"),
        ("LABEL = 'Mine'\ndef build():\n    return None\n", "a geomdl surface is needed"),
    ],
)
def test_surface_files_that_build_none(tmp_path, text, message):
    file = tmp_path / "mine.py"
    file.write_text(text)
    with pytest.raises(curvlib.InputError, match=f"surface file .*mine.py'.*{message}"):
        curvlib.surface(str(file))
