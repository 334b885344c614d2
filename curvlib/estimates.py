"""What an estimate comes to: the quantities at the vertices, and what is undefined and why."""

import warnings
from functools import cached_property

import numpy as np

from .errors import MeshWarning


class Estimates:
    """Pointwise curvature at the vertices of a mesh; NaN where undefined.

    Attributes
    ----------
    K, H : ndarray of float64, (V,)
        Gaussian and mean curvature, in 1/length^2 and 1/length; H > 0 where the surface bends
        away from its normal.
    k1, k2 : ndarray of float64, (V,)
        Principal curvatures, k1 >= k2. Of an estimator of K and H alone they are
        H +- sqrt(H^2 - K), NaN where H^2 < K.
    d1, d2 : ndarray of float64, (V, 3), or None
        Their unit directions, where the estimator gives them.
    """

    def __init__(self, mesh, found: dict):
        """`found`: the arrays by name that the estimator returned."""
        self._mesh, self._found = mesh, found
        self.d1, self.d2 = found.get("d1"), found.get("d2")
        for name in ("K", "H"):
            values = found.get(name)
            setattr(self, name, np.full(len(mesh.vertices), np.nan) if values is None else values)

    @property
    def k1(self) -> np.ndarray:
        """The larger principal curvature, (V,)."""
        return self._principal[0]

    @property
    def k2(self) -> np.ndarray:
        """The smaller principal curvature, (V,)."""
        return self._principal[1]

    @property
    def shape_index(self) -> np.ndarray:
        """2/pi atan2(k1 + k2, k1 - k2), (V,), in [-1, 1]: +1 on a sphere, 0 on a symmetric
        saddle; NaN where k1 = k2 = 0."""
        k1, k2 = self._principal
        with np.errstate(invalid="ignore"):
            index = 2 / np.pi * np.arctan2(k1 + k2, k1 - k2)
        return np.where((k1 == 0) & (k2 == 0), np.nan, index)

    @property
    def curvedness(self) -> np.ndarray:
        """sqrt((k1^2 + k2^2) / 2), (V,), in 1/length."""
        return np.hypot(*self._principal) / np.sqrt(2)

    @cached_property
    def undefined(self) -> dict[str, int]:
        """How many vertices lack a value that the estimator gives elsewhere, by cause; where it
        gives none, all of them."""
        lacking = np.full(len(self._mesh.vertices), not self._found)
        for values in self._found.values():
            lacking |= np.isnan(values.reshape(len(lacking), -1)).any(1)
        return {cause: int(n) for cause, n in _causes(self._mesh, lacking).items() if n}

    @cached_property
    def _principal(self):
        if "k1" in self._found:
            return self._found["k1"], self._found["k2"]
        from .kit.tensor import principal_values

        return principal_values(self.K, self.H)

    def __iter__(self):
        """K and H, so that `K, H = estimate(...)` works."""
        return iter((self.K, self.H))

    def __repr__(self):
        names = ", ".join(self._found) or "nothing"
        return f"<Estimates of {names} at {len(self.K)} vertices>"


def _causes(mesh, lacking):
    """Cause -> number of the vertices `lacking` (V,) bool a value."""
    used = np.zeros(len(lacking), dtype=bool)
    used[mesh.faces] = True
    open_ = used & ~mesh.closed
    return {
        "no triangle": (lacking & ~used).sum(),
        "boundary": (lacking & open_ & mesh.boundary).sum(),
        "triangles that do not close to one ring": (lacking & open_ & ~mesh.boundary).sum(),
        "no finite value": (lacking & mesh.closed).sum(),
    }


def warn_of_undefined(mesh, closed: int) -> None:
    """Warn where `closed`, how many vertices have a closed ring, leaves much undefined."""
    count = len(mesh.vertices)
    if closed == count:
        return
    rest = mesh.vertices[~mesh.closed]
    twice = len(rest) - len(np.unique(rest, axis=0))
    if 2 * closed >= count and not twice:
        return
    causes = _causes(mesh, ~mesh.closed)
    message = f"{count - closed} of {count} vertices have no value: "
    message += ", ".join(f"{n} {cause}" for cause, n in causes.items() if n)
    if twice:
        message += (
            f"; {twice} stand where another one does: join them, e.g. by pyvista's "
            ".clean(lines_to_points=False, polys_to_lines=False, strips_to_polys=False)"
        )
    warnings.warn(message, MeshWarning, stacklevel=3)
