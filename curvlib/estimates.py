"""The result of an estimate: the quantities at the vertices."""

from functools import cached_property

import numpy as np

from .causes import causes_at_triangles, causes_at_vertices

# Curvedness times the size of a surface, below which it is flat: it bends by its 8000th part.
FLAT = 1e-3


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
    category : ndarray of float64, (V,)
        The code of one of ten shapes, in `curvlib.columns.CATEGORIES`: cup, trough, rut, saddle
        rut, saddle, saddle ridge, ridge, dome, cap (Koenderink and van Doorn 1992), which is
        4 (shape_index + 1), rounded: cylinders and spheres lie amid a category and not, as with
        signs of K and H, at the limit of two; and flat, where curvedness times the diagonal of
        the mesh's box is below 0.001.
    K_error, H_error, k1_error, k2_error : ndarray of float64, (V,), or None
        Standard errors of K, H, k1 and k2; None where the estimator does not return them.
    crease : ndarray of bool, (V,), or None
        On a crease (`curvlib.meshes.creases`), of a triangle an edge; None where not looked for.
    choice : curvlib.kit.tensor.Choice or None
        What an estimator that chooses took at each vertex: `choice.calls[choice.index[v]]`.
    returned : tuple of str
        The quantities that the estimator returns; others follow from K and H, or are undefined.
    mesh : Mesh
        On whose vertices the values are.
    used : Mesh
        That of the estimate: with points joined that stand at one place, and without triangles that
        are there again.
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

    K: np.ndarray
    H: np.ndarray

    def __init__(
        self,
        mesh,
        found: dict,
        given: str,
        per: str = "vertex",
        welded=None,
        index=None,
        choice=None,
        crease=None,
    ):
        """`found`: the arrays that the estimator returned, by name; `given`: what it was given;
        `welded` and `index`: as `curvlib.weld` returns them; other values are those of `welded`."""
        self.mesh, self.per = mesh, per
        self.used, self._given, self._index = mesh if welded is None else welded, given, index
        if index is not None and per == "vertex":
            found = {name: values[index] for name, values in found.items()}
            choice = choice and choice._replace(index=choice.index[index])
            crease = None if crease is None else crease[index]
        self._found = {name: x for name, x in found.items() if not name.endswith("_error")}
        self.choice, self.crease = choice, crease
        count = len(mesh.vertices if per == "vertex" else mesh.faces)
        self.d1, self.d2 = found.get("d1"), found.get("d2")
        self.K_error, self.H_error = found.get("K_error"), found.get("H_error")
        self.k1_error, self.k2_error = found.get("k1_error"), found.get("k2_error")
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

    @property
    def category(self) -> np.ndarray:
        """The code of the shape's category, (V,): 4 (shape_index + 1), rounded, or 9 for flat."""
        unit, points = self.mesh.unit, self.mesh.vertices[self.mesh.faces].reshape(-1, 3)
        diagonal = np.linalg.norm(np.ptp(points * unit, axis=0)) / unit if len(points) else 0.0
        flat = self.curvedness * diagonal < FLAT
        return np.where(flat, 9.0, np.round(4 * (self.shape_index + 1)))

    def bending_energy(self, c0: float = 0.0) -> np.ndarray:
        """Helfrich's bending energy per area, (2 H - c0)^2 / 2, in units of the bending rigidity.

        Parameters
        ----------
        c0 : float
            Spontaneous curvature, in 1/length; positive as H is.

        Returns
        -------
        ndarray of float64, (V,)
            In 1/length^2. Source: Helfrich (1973), https://doi.org/10.1515/znc-1973-11-1209.
        """
        return (2 * self.H - c0) ** 2 / 2

    def integral(self, values) -> float:
        """The integral of a quantity over the area of the mesh where it is defined.

        Parameters
        ----------
        values : ndarray of float64, (V,)

        Returns
        -------
        float
            NaN where no value is finite.

        Examples
        --------
        >>> import curvlib
        >>> mesh = curvlib.tessellate(curvlib.surface("sphere"), 32)
        >>> estimates = curvlib.estimate(mesh, "quadric")
        >>> round(estimates.integral(estimates.bending_energy()) / 3.1416)  # 8 pi
        8
        """
        from .regions import integral

        return integral(self.used, values, self.per)

    @cached_property
    def undefined(self) -> dict[str, int]:
        """Cause -> number of vertices that lack a value which the estimator returns elsewhere.

        Where it returns no value at all, every vertex lacks one.
        """
        lacking = np.full(len(self.K), not self._found)
        undirected = np.zeros_like(lacking)
        for name, values in self._found.items():
            if name in ("d1", "d2"):
                undirected |= np.isnan(values).any(1)
            else:
                lacking |= np.isnan(values)
        if self.per == "face":
            causes = causes_at_triangles(self.mesh, lacking, self.used)
        else:
            causes = causes_at_vertices(self.used, lacking, self._given, self._index, self.crease)
        causes["umbilic, without d1 and d2"] = (undirected & ~lacking).sum()
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
        from .notebooks import as_html

        return as_html(self)
