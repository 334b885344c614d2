"""Triangle meshes: validation, boundary, and ordered one-rings in batches of equal valence."""

from functools import cached_property

import numpy as np

from curvlib.errors import InputError

# Exact values that a mesh can carry, with the shape behind V.
FIELDS = {
    "uv": (2,),
    "normals": (3,),
    "K": (),
    "H": (),
    "k1": (),
    "k2": (),
    "d1": (3,),
    "d2": (3,),
    "smooth": (),
    "pole": (),
}


class Mesh:
    """A triangle mesh, with exact values at its vertices where it was made from a surface.

    `vertices` (V, 3) float64, `faces` (F, 3) int, counter-clockwise seen from outside.
    Optional, else None: `uv` (V, 2), `normals` (V, 3) unit, `K`, `H`, `k1`, `k2` (V,) exact
    and pointwise, their directions `d1`, `d2` (V, 3) unit, `smooth` and `pole` (V,) bool:
    the surface is C^2 there, a line of its parameters shrinks to that point.

    Raises InputError where an array has the wrong shape, a coordinate is not finite or a face
    refers to no vertex.
    """

    def __init__(self, vertices, faces, **fields):
        self._vertices = np.ascontiguousarray(vertices, dtype=float)
        faces = np.asarray(faces)
        if faces.size and not np.issubdtype(faces.dtype, np.integer):
            raise InputError(f"faces: indices have to be integers, not {faces.dtype}")
        self._faces = np.ascontiguousarray(faces, dtype=np.intp)
        _check_rows("vertices", self.vertices, 3)
        _check_rows("faces", self.faces, 3)
        count = len(self.vertices)
        bad = ~np.isfinite(self.vertices)
        if bad.any():
            raise InputError(
                f"vertices: vertex {np.argmax(bad) // 3} has a coordinate that is not finite"
            )
        indices = self.faces.view(np.uintp)  # a negative one is large without its sign
        if indices.size and indices.max() >= count:
            row = int(np.argmax(indices >= count)) // 3
            raise InputError(
                f"faces: face {row} is {self.faces[row].tolist()}, "
                f"but vertex indices run from 0 to {count - 1}"
            )
        for name, rest in FIELDS.items():
            value = fields.pop(name, None)
            if value is not None:
                value = np.asarray(value)
                if value.shape != (count, *rest):
                    raise InputError(f"{name}: shape {value.shape}, expected {(count, *rest)}")
            setattr(self, name, value)
        if fields:
            raise TypeError(f"Mesh has no field {next(iter(fields))!r}")

    @property
    def vertices(self):
        """(V, 3) float64; a mesh with others is another: see `moved`."""
        return self._vertices

    @property
    def faces(self):
        """(F, 3) int, counter-clockwise seen from outside."""
        return self._faces

    def __repr__(self):
        return f"<Mesh of {len(self.vertices)} vertices, {len(self.faces)} faces>"

    def moved(self, vertices) -> "Mesh":
        """The mesh with its vertices elsewhere: faces, rings and normals stay, exact values do
        not hold any more."""
        mesh = Mesh(vertices, self.faces, normals=self.normals)
        mesh.__dict__["rings"] = self.rings
        return mesh

    @property
    def H2(self):
        """H^2, (V,), which the paper's library holds; None without H."""
        return None if self.H is None else self.H * self.H

    @cached_property
    def boundary(self):
        """(V,) bool: the vertex lies on an edge of one face only."""
        start, end = self.faces.ravel(), np.roll(self.faces, -1, axis=1).ravel()
        edge = np.minimum(start, end) * len(self.vertices) + np.maximum(start, end)
        _, at, faces = np.unique(edge, return_index=True, return_counts=True)
        on_boundary = np.zeros(len(self.vertices), dtype=bool)
        for ends in (start, end):
            on_boundary[ends[at[faces == 1]]] = True
        return on_boundary

    @cached_property
    def rings(self):
        """Closed one-rings in batches of equal valence n: list of (vertices (m,), neighbours
        (n, m)), int32; a valence may have several batches.

        Neighbours run counter-clockwise. Vertices whose triangles do not close to exactly one
        cycle are in no batch.
        """
        return self.find_rings()

    def find_rings(self, threads: int = 1):
        """`rings`, found by several threads if they are not known yet."""
        if "rings" in self.__dict__:
            return self.rings
        from .corners import one_rings

        self.__dict__["rings"] = one_rings(self.faces, len(self.vertices), threads)
        return self.rings


def as_mesh(obj) -> Mesh:
    """`obj` if it is a Mesh, else one from (vertices, faces) or from what pyvista can wrap.

    Raises InputError where that is no triangle mesh.
    """
    if isinstance(obj, Mesh):
        return obj
    if isinstance(obj, (tuple, list)):
        if len(obj) != 2:
            raise InputError(f"a mesh is a pair (vertices, faces), not {len(obj)} things")
        return Mesh(*obj)
    try:
        import pyvista
    except ImportError:
        raise InputError(
            f"a mesh is a curvlib.Mesh or a pair (vertices, faces); for {type(obj).__name__} "
            "install pyvista"
        ) from None
    try:
        data = pyvista.wrap(obj)
    except (NotImplementedError, TypeError, ValueError) as error:
        raise InputError(f"pyvista cannot wrap {type(obj).__name__}: {error}") from None
    if not isinstance(data, pyvista.PolyData) or not data.is_all_triangles:
        raise InputError(
            f"{type(data).__name__} is no triangle mesh; pass its .extract_surface().triangulate()"
        )
    return Mesh(np.asarray(data.points), data.regular_faces)


def _check_rows(name, array, width):
    if array.ndim != 2 or array.shape[1] != width:
        raise InputError(f"{name}: shape {array.shape}, expected (rows, {width})")
