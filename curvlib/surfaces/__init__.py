"""The surfaces of the study: one file each, found by listing this folder.

A file holds LABEL (for legends) and build(), which returns a geomdl NURBS surface whose
normal S_u x S_v points outward. Closed directions and poles are read off the control net.
"""

from curvlib.catalogue import surfaces
from curvlib.nurbs.surface import Surface


def load(name: str) -> Surface:
    """The surface of that name, or of a path to a .py file; InputError if there is none."""
    module = surfaces.module(name)
    return Surface(module.build(), name=surfaces.path(name).stem, label=module.LABEL)
