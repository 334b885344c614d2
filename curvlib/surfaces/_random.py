"""Random shapes of four families, beside the surfaces of which the paper tells no proportions.

A radius, a semi-axis and half of a height are log-uniform over a decade, from 0.316 to 3.16, and
rounded to three decimals: a shape is what its proportions say.
"""

from collections import namedtuple

import numpy as np

from curvlib.nurbs.surface import Surface

from . import sphere
from ._shapes import revolve, scale

COUNT = 24

Shape = namedtuple("Shape", "family number proportions surface")
Shape.__doc__ = """A random shape: the number in its family, from 1; its proportions in words; the
Surface, named `<family>-<number>`."""


def random_shapes(count: int = COUNT, seed: int = 0):
    """Yield `count` shapes of each family. Those of a smaller count are the first of a larger."""
    for stream, (family, draw) in enumerate(FAMILIES.items()):
        rng = np.random.default_rng([seed, stream])
        for number in range(1, count + 1):
            proportions, model = draw(rng)
            words = ", ".join(
                f"{name}={' '.join(f'{x:g}' for x in np.atleast_1d(values))}"
                for name, values in proportions.items()
            )
            yield Shape(family, number, words, Surface(model, f"{family}-{number:02d}"))


def _lengths(rng, count):
    return (10 ** (rng.random(count) - 0.5)).round(3)


def _arc(rng):
    """A cubic arc, turned about the z axis: the radius is nowhere less than the least of the four
    control points, whose heights rise, so that the arc has no cusp."""
    radii, height = _lengths(rng, 4), 2 * _lengths(rng, 1)
    inner = np.sort(rng.random(2)) * height
    heights = np.concatenate(([0], inner, height)).round(3)
    profile = np.stack((radii, heights), 1)
    return {"radii": radii, "heights": heights}, revolve(3, [0] * 4 + [1] * 4, profile)


def _ellipsoid(rng):
    axes = _lengths(rng, 3)
    return {"semi-axes": axes}, scale(sphere.build(), axes)


def _frustum(rng):
    radii, height = _lengths(rng, 2), 2 * _lengths(rng, 1)[0]
    profile = [(radii[0], 0), (radii[1], height)]
    return {"radii": radii, "height": height}, revolve(1, [0, 0, 1, 1], profile)


def _cylinder(rng):
    radius, height = _lengths(rng, 2) * (1, 2)
    profile = [(radius, 0), (radius, height)]
    return {"radius": radius, "height": height}, revolve(1, [0, 0, 1, 1], profile)


FAMILIES = {"arc": _arc, "ellipsoid": _ellipsoid, "frustum": _frustum, "cylinder": _cylinder}
