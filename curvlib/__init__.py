"""Gaussian curvature K and mean curvature H on triangle meshes.

Estimators at the vertices of a mesh, NURBS surfaces with exact curvature to judge them by,
and the comparison of Surazhsky, Magid, Soldea, Elber and Rivlin (ICRA 2003), reproduced.

Everywhere: normals point outward on closed surfaces; H > 0 where the surface bends away from
its normal (the unit sphere has K = +1, H = +1); k1 >= k2; values are pointwise, never
integrated over a cell; undefined is NaN.
"""

from .errors import InputError
from .estimation import Estimates, estimate
from .estimators import names as estimators
from .library import load_library
from .mesh import Mesh
from .nurbs import Curvature, Surface
from .surfaces import load as surface
from .surfaces import names as surfaces
from .tessellation import tessellate

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
