"""Gaussian curvature K and mean curvature H on triangle meshes.

Estimators at the vertices of a mesh, NURBS surfaces with exact curvature to judge them by,
and the comparison of Surazhsky, Magid, Soldea, Elber and Rivlin (ICRA 2003), reproduced.

Everywhere: normals point outward on closed surfaces; H > 0 where the surface bends away from
its normal (the unit sphere has K = +1, H = +1); k1 >= k2; values are pointwise, never
integrated over a cell; undefined is NaN.
"""

import importlib

# Importing a package binds its name here. These three must be bound before the functions of the
# same names take their places.
from . import estimators, peers, surfaces
from .catalogue import estimators as _estimators
from .catalogue import peers as _peers
from .catalogue import surfaces as _surfaces

__version__ = "0.2.0"

# Public name -> where it is defined; imported at first use (PEP 562).
_PUBLIC = {
    "Curvature": "nurbs.surface",
    "Estimates": "estimates",
    "InputError": "errors",
    "Mesh": "meshes.mesh",
    "MeshWarning": "errors",
    "Surface": "nurbs.surface",
    "check": "meshes.check",
    "estimate": "estimation",
    "load_library": "dataset.library",
    "orient": "meshes.mend",
    "read": "meshes.exchange",
    "surface": "surfaces._named",
    "tessellate": "nurbs.tessellation",
    "weld": "meshes.mend",
}

__all__ = ["estimators", "peers", "surfaces", *_PUBLIC]

estimators = _estimators.names  # noqa: F811
peers = _peers.names  # noqa: F811
surfaces = _surfaces.names  # noqa: F811


def __getattr__(name):
    if name not in _PUBLIC:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(importlib.import_module(f"{__name__}.{_PUBLIC[name]}"), name)
    globals()[name] = value
    return value


def __dir__():
    return sorted({*globals(), *__all__})
