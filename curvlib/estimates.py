"""The result of an estimate: the quantities at the vertices, and the causes of undefined ones."""

import warnings
from functools import cached_property

import numpy as np

from .errors import MeshWarning

# What estimators are given that need a disk or half-disk instead of a ring.
DISKS = ("disk", "ball", "passes")


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
    K_error, H_error : ndarray of float64, (V,), or None
        Their standard errors; None where the estimator does not return them.
    choice : curvlib.kit.tensor.Choice or None
        What an estimator that chooses took at each vertex: `choice.calls[choice.index[v]]`.
    returned : tuple of str
        The quantities that the estimator returns; others follow from K and H, or are undefined.
    mesh : Mesh
        On whose vertices the values are.
    per : str
        "vertex", or "face" for values at the triangles' centres: then V counts triangles.
    undefined : dict
        Cause -> number of vertices, or triangles, with a NaN.

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

    def __init__(
        self,
        mesh,
        found: dict,
        given: str,
        per: str = "vertex",
        welded=None,
        index=None,
        choice=None,
    ):
        """`found`: the arrays that the estimator returned, by name; `given`: what it was given;
        `welded` and `index`: as `curvlib.weld` returns them, where `mesh` has been welded."""
        self.mesh, self.per = mesh, per
        self._mesh, self._given, self._index = mesh if welded is None else welded, given, index
        if index is not None and per == "vertex":
            found = {name: values[index] for name, values in found.items()}
            choice = choice and choice._replace(index=choice.index[index])
        self.K_error, self.H_error = found.get("K_error"), found.get("H_error")
        self._found = {name: x for name, x in found.items() if not name.endswith("_error")}
        self.choice = choice
        count = len(mesh.vertices if per == "vertex" else mesh.faces)
        self.d1, self.d2 = found.get("d1"), found.get("d2")
        for name in ("K", "H"):
            values = found.get(name)
            setattr(self, name, np.full(count, np.nan) if values is None else values)

    @property
    def returned(self) -> tuple[str, ...]:
        """The quantities that the estimator returns."""
        return tuple(self._found)

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
        lacking = np.full(len(self.K), not self._found)
        for values in self._found.values():
            lacking |= np.isnan(values.reshape(len(lacking), -1)).any(1)
        if self.per == "face":
            a, b, c = self._mesh.vertices[self._mesh.faces].transpose(1, 0, 2)
            flat = ~(np.cross(b - a, c - a) != 0).any(1)
            causes = {"triangle without area": (lacking & flat).sum()}
            causes["no finite value"] = (lacking & ~flat).sum()
        else:
            causes = _causes(self._mesh, lacking, self._given, self._index)
        return {cause: int(n) for cause, n in causes.items() if n}

    @cached_property
    def _principal(self):
        if "k1" in self._found:
            return self._found["k1"], self._found["k2"]
        from .kit.tensor import principal_values

        return principal_values(self.K, self.H)

    def __iter__(self):
        """K and H, so that `K, H = estimate(...)` works."""
        return iter((self.K, self.H))

    def to_polydata(self, columns: str = "curvlib"):
        """The mesh as a pyvista.PolyData with the quantities as point data, or cell data where they
        are per face.

        Parameters
        ----------
        columns : {"curvlib", "pycurv"}
            Their names: K, H, k1, ... or, per face, those of pycurv.

        Returns
        -------
        pyvista.PolyData
        """
        from .columns import columns as named
        from .meshes.writing import polydata

        return polydata(self.mesh, named(self, columns), self.per)

    def to_dataframe(self, columns: str = "curvlib"):
        """The quantities as columns of a pandas.DataFrame, a row for each vertex or face.

        Parameters
        ----------
        columns : {"curvlib", "pycurv"}
            As in `to_polydata`; each vector is three columns, d1 is d1_x, d1_y, d1_z.

        Returns
        -------
        pandas.DataFrame
        """
        import pandas

        from .columns import columns as named
        from .columns import scalars

        return pandas.DataFrame(scalars(named(self, columns)))

    def __repr__(self):
        names = ", ".join(self.returned) or "nothing"
        places = "vertices" if self.per == "vertex" else "triangles"
        return f"<Estimates of {names} at {len(self.K)} {places}>"

    def _repr_html_(self):
        """A table of quantiles over the area, for notebooks."""
        from .columns import columns
        from .regions import PROBABILITIES, quantiles

        heads = "".join(f"<th>{100 * p:.0f} %</th>" for p in PROBABILITIES)
        rows = [
            f"<tr><th>{name}</th>{''.join(f'<td>{x:.4g}</td>' for x in found)}</tr>"
            for name, values in columns(self).items()
            if values.ndim == 1
            for found in [quantiles(self.mesh, values, self.per)]
        ]
        lacking = ", ".join(f"{n} {cause}" for cause, n in self.undefined.items()) or "nowhere"
        return (
            f"<p>{repr(self)[1:-1]}; undefined: {lacking}</p>"
            f"<table><tr><th>over the area</th>{heads}</tr>{''.join(rows)}</table>"
        )


def _stars(mesh, given):
    """(V,) bool: an estimator is given the ring or disk of the vertex; its triangles close to one
    ring."""
    if given not in DISKS:
        return mesh.closed, mesh.closed
    from .meshes.neighbourhoods import BROKEN, CLOSED

    stars = mesh.find_adjacency().stars
    return stars != BROKEN, stars == CLOSED


def _causes(mesh, lacking, given, index=None):
    """Cause -> number of the vertices `lacking` (V,) bool a value; `index` as in Estimates."""
    used = np.zeros(len(lacking), dtype=bool)
    used[mesh.faces] = True
    usable, boundary = _stars(mesh, given)[0], mesh.boundary
    if index is not None:
        used, usable, boundary = used[index], usable[index], boundary[index]
    causes = {"no triangle": (lacking & ~used).sum()}
    open_ = lacking & used & ~usable
    if given in DISKS:
        causes["triangles that form no disk or half-disk"] = open_.sum()
    else:
        causes["boundary"] = (open_ & boundary).sum()
        causes["triangles that do not close to one ring"] = (open_ & ~boundary).sum()
    return causes | {"no finite value": (lacking & usable).sum()}


def joined(mesh, given):
    """The mesh with points joined that stand at one place, and their index as `curvlib.weld`
    returns it, None where there are none; warns where there are some.

    `given`: what the estimator is given.
    """
    loose = mesh.vertices[~_stars(mesh, given)[1]]
    if len(np.unique(loose, axis=0)) == len(loose):
        return mesh, None
    from .meshes.mend import weld

    welded, index = weld(mesh)
    count = np.count_nonzero(index != np.arange(len(index)))
    if not count:
        return mesh, None
    _warn(f"{count} of {len(index)} vertices stand where another one does: joined to it")
    return welded, index


def warn_of_undefined(mesh, given: str, index=None) -> None:
    """Warn if fewer than half of the vertices have a ring, or disk where that is `given`; `index`
    as in Estimates."""
    if given == "mesh":
        return
    usable = _stars(mesh, given)[0] if index is None else _stars(mesh, given)[0][index]
    lacking = np.count_nonzero(~usable)
    if 2 * lacking > len(usable):
        causes = _causes(mesh, ~usable, given, index)
        named = ", ".join(f"{n} {cause}" for cause, n in causes.items() if n)
        _warn(f"{lacking} of {len(usable)} vertices have no value: {named}")


def _warn(words):
    warnings.warn(words, MeshWarning, stacklevel=4)
