"""Gaussian curvature K and mean curvature H on triangle meshes.

Estimators at the vertices of a mesh, NURBS surfaces with exact curvature to judge them by,
and the comparison of Surazhsky, Magid, Soldea, Elber and Rivlin (ICRA 2003), reproduced.

Everywhere: normals point outward on closed surfaces; H > 0 where the surface bends away from
its normal (the unit sphere has K = +1, H = +1); k1 >= k2; values are pointwise, never
integrated over a cell; undefined is NaN.
"""

# The packages come first: imported later, they would take the place of the functions that
# have their names.
from curvlib.catalogue import estimators as _estimators
from curvlib.catalogue import surfaces as _surfaces
from curvlib.dataset.library import load_library
from curvlib.errors import InputError
from curvlib.estimation import Estimates, estimate
from curvlib.meshes.mesh import Mesh
from curvlib.nurbs.surface import Curvature, Surface
from curvlib.nurbs.tessellation import tessellate
from curvlib.surfaces import load as surface

from . import estimators, surfaces

__version__ = "0.1.0"

__all__ = [
    "Curvature",
    "Estimates",
    "InputError",
    "Mesh",
    "Surface",
    "estimate",
    "estimators",
    "load_library",
    "surface",
    "surfaces",
    "tessellate",
]

estimators = _estimators.names  # noqa: F811
surfaces = _surfaces.names  # noqa: F811
