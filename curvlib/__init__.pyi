"""The public names for type checkers: `__init__.py` imports them at first use."""

from collections.abc import Callable
from os import PathLike
from typing import Any, Literal, overload

from .dataset.library import load_library as load_library
from .errors import InputError as InputError
from .errors import MeshWarning as MeshWarning
from .estimates import Estimates as Estimates
from .meshes.check import check as check
from .meshes.exchange import read as read
from .meshes.mend import orient as orient
from .meshes.mend import weld as weld
from .meshes.mesh import Mesh as Mesh
from .nurbs.surface import Curvature as Curvature
from .nurbs.surface import Surface as Surface
from .nurbs.tessellation import tessellate as tessellate
from .surfaces._named import surface as surface

__version__: str

def estimators() -> list[str]: ...
def peers() -> list[str]: ...
def surfaces() -> list[str]: ...

_Estimator = str | PathLike[str] | Callable[..., Any]

@overload
def estimate(
    mesh: Any,
    estimator: _Estimator | None = None,
    threads: int = 1,
    per: Literal["vertex", "face"] = "vertex",
    creases: Literal["ignore", "one-sided", "nan"] | None = None,
    **options: Any,
) -> Estimates: ...
@overload
def estimate(
    mesh: Any,
    estimator: list[str] | list[_Estimator] | tuple[_Estimator, ...],
    threads: int = 1,
    per: Literal["vertex", "face"] = "vertex",
    creases: Literal["ignore", "one-sided", "nan"] | None = None,
    **options: Any,
) -> dict[Any, Estimates]: ...
