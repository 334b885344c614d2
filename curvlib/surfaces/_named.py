"""Surfaces by name."""

from curvlib.catalogue import surfaces
from curvlib.nurbs.surface import Surface


def surface(name: str) -> Surface:
    """The surface of that name, or of a path to a .py file; InputError if there is none."""
    module = surfaces.module(name)
    return Surface(module.build(), name=surfaces.path(name).stem, label=module.LABEL)
