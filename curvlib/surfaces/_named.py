"""Surfaces by name."""

import inspect
from pathlib import Path

from curvlib.catalogue import surfaces
from curvlib.errors import InputError
from curvlib.nurbs.surface import Surface


def surface(name: str) -> Surface:
    """A surface by name, or from a file.

    Parameters
    ----------
    name : str
        A name in `curvlib.surfaces()`, or the path of a .py file with LABEL (for legends) and
        build(), which returns a geomdl surface.

    Returns
    -------
    Surface
        Its normal S_u x S_v points outward on the surfaces of the package.

    Raises
    ------
    InputError
        An unknown name, or a file that lacks LABEL or build() or does not build a surface.

    Examples
    --------
    >>> import curvlib
    >>> curvlib.surface("teapot_spout")
    <Surface 'teapot_spout', domain ((0.0, 2.0), (0.0, 2.0))>
    """
    module = surfaces.module(name)
    try:
        inspect.signature(module.build).bind()
    except TypeError as error:
        raise InputError(f"surface file {str(name)!r}: build: {error}") from None
    try:
        return Surface(module.build(), name=Path(name).stem, label=module.LABEL)
    except InputError as error:
        raise InputError(f"surface file {str(name)!r}: {error}") from None
