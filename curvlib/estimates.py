"""The result of an estimate: the quantities at the vertices, and the causes of undefined ones."""

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
        Principal curvatures in 1/length, k1 >= k2. For an estimator of K and H alone they are
        H +- sqrt(H^2 - K), NaN where H^2 < K.
    d1, d2 : ndarray of float64, (V, 3), or None
        Their unit directions; None where the estimator does not return them.
    shape_index : ndarray of float64, (V,)
        2/pi atan2(k1 + k2, k1 - k2) in [-1, 1]: +1 on a sphere with outward normals, 0 on a
        symmetric saddle; NaN where k1 = k2 = 0.
    curvedness : ndarray of float64, (V,)
        sqrt((k1^2 + k2^2) / 2), in 1/length.
    undefined : dict
        Cause -> number of vertices with a NaN.

    Examples
    --------
    >>> import curvlib
    >>> mesh = curvlib.tessellate(curvlib.surface("cylinder"), 8)
    >>> estimates = curvlib.estimate(mesh, "gauss_bonnet")
    >>> estimates
    <Estimates of K, H at 72 vertices>
    >>> estimates.undefined
    {'boundary': 16}
    >>> K, H = estimates
    """

    def __init__(self, mesh, found: dict):
        """`found`: the arrays that the estimator returned, by name."""
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
        """2/pi atan2(k1 + k2, k1 - k2), (V,), in [-1, 1]; NaN where k1 = k2 = 0."""
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
        """Cause -> number of vertices that lack a value which the estimator returns elsewhere.

        Where it returns no value at all, every vertex lacks one.
        """
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
    """Warn if fewer than half of the vertices have a closed ring, or some without one coincide.

    `closed`: the number of vertices with a closed ring.
    """
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
