"""Triangle meshes: validation, boundary, and ordered one-rings in batches of equal valence."""

import math
from functools import cached_property

import numpy as np

from curvlib.errors import InputError, check_name

from .arrays import any_array, frozen, numbers

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
FLAGS = ("smooth", "pole")

# Rings are stored as 32-bit indices.
MOST_VERTICES = 1 << 31

# Coordinates within the range of float32 are not scaled: fifth powers of lengths fit float64.
RANGE = 2.0**128

# Normals within this of unit length are not rescaled.
UNIT = 1e-12


class Mesh:
    """A triangle mesh, with exact values at its vertices where it was made from a surface.

    Attributes
    ----------
    concerned, left_out : ndarray of bool, (V,) and (F,), or None
        Vertices whose position is not finite, or with a triangle that is left out for such a one;
        triangles that are left out, for this or, by `curvlib.weld`, as they are there again. None
        where there are none.

    Parameters
    ----------
    vertices : array_like of float, (V, 3)
        Coordinates, in the unit of the mesh. Triangles at a vertex with one that is not finite are
        left out: they name another vertex three times. The vertex itself is NaN.
    faces : array_like of int, (F, 3)
        Vertex indices, counter-clockwise seen from outside.
    copy : bool
        False shares the caller's arrays, which must not change while the mesh is in use.
    **fields : array_like, optional
        `uv` (V, 2); `normals` (V, 3), pointing outward, brought to unit length; exact values,
        pointwise: `K`, `H`, `k1`, `k2` (V,), the principal directions `d1`, `d2` (V, 3) unit;
        `smooth` (V,) bool, the surface is C^2 there; `pole` (V,) bool, a parameter line collapses
        there. None where not given.

    Raises
    ------
    InputError
        An array has the wrong shape or type, each face has a coordinate that is not finite, or one
        refers to no vertex.

    Examples
    --------
    >>> from curvlib import Mesh
    >>> Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]).boundary
    array([ True,  True,  True])
    """

    uv: np.ndarray | None
    normals: np.ndarray | None
    K: np.ndarray | None
    H: np.ndarray | None
    k1: np.ndarray | None
    k2: np.ndarray | None
    d1: np.ndarray | None
    d2: np.ndarray | None
    smooth: np.ndarray | None
    pole: np.ndarray | None

    def __init__(self, vertices, faces, copy: bool = True, **fields):
        self._vertices = frozen(numbers("vertices", vertices, float, copy))
        self._faces = frozen(numbers("faces", faces, np.intp, copy))
        self._rings = self._adjacency = None
        for name, array in (("vertices", self.vertices), ("faces", self.faces)):
            if array.ndim != 2 or array.shape[1] != 3:
                raise InputError(f"{name}: shape {array.shape}, expected (rows, 3)")
        count = len(self.vertices)
        if max(count, 3 * len(self.faces)) >= MOST_VERTICES:
            raise InputError(f"mesh: more than {MOST_VERTICES} vertices or corners of faces")
        # NaN and infinities show in the extremes, which `unit` needs too.
        self._largest = float(max(self.vertices.max(), -self.vertices.min())) if count else 0.0
        indices = self.faces.view(np.uintp)  # unsigned, a negative index is large
        if indices.size and indices.max() >= count:
            row = int(np.argmax(indices >= count)) // 3
            raise InputError(
                f"faces: face {row} is {self.faces[row].tolist()}, "
                f"but vertex indices run from 0 to {count - 1}"
            )
        self.concerned = self.left_out = None
        if not math.isfinite(self._largest):
            self._leave_out()
        for name in fields:
            check_name("field", name, FIELDS, "mesh")
        for name, rest in FIELDS.items():
            setattr(self, name, _field(name, fields.get(name), (count, *rest), copy))

    def __setstate__(self, state):
        # Pickle forgets that arrays are read only; compiled code is kept for those that are.
        for name, value in state.items():
            vars(self)[name] = frozen(value) if isinstance(value, np.ndarray) else value

    @property
    def vertices(self) -> np.ndarray:
        """(V, 3) float64, read only; `moved` makes a mesh with others."""
        return self._vertices

    @property
    def faces(self) -> np.ndarray:
        """(F, 3) int, read only, counter-clockwise seen from outside."""
        return self._faces

    def __repr__(self):
        return f"<Mesh of {len(self.vertices)} vertices, {len(self.faces)} faces>"

    def moved(self, vertices) -> "Mesh":
        """A mesh with the same faces and rings, other vertices, and no normals or exact values.

        Parameters
        ----------
        vertices : array_like of float, (V, 3)

        Returns
        -------
        Mesh
        """
        mesh = Mesh(vertices, self.faces)
        mesh._rings, mesh._adjacency = self.rings, self._adjacency
        return mesh

    def _leave_out(self):
        """Leave out triangles at positions that are not finite."""
        from .sound import placed

        vertices, faces, self.concerned, self.left_out = placed(self.vertices, self.faces)
        self._vertices, self._faces = frozen(vertices), frozen(faces)
        self._largest = float(np.nanmax(np.abs(vertices)))

    @property
    def H2(self) -> np.ndarray | None:
        """H^2, (V,), in 1/length^2, as in the paper's library; None without H."""
        return None if self.H is None else self.H * self.H

    @cached_property
    def boundary(self) -> np.ndarray:
        """(V,) bool: the vertex lies on an edge of one face only.

        A face that names a vertex twice has no area and is left out.
        """
        a, b, c = self.faces.T
        faces = self.faces[(a != b) & (b != c) & (c != a)]
        start, end = faces.ravel(), np.roll(faces, -1, axis=1).ravel()
        edge = np.minimum(start, end) * len(self.vertices) + np.maximum(start, end)
        _, at, uses = np.unique(edge, return_index=True, return_counts=True)
        on_boundary = np.zeros(len(self.vertices), dtype=bool)
        for ends in (start, end):
            on_boundary[ends[at[uses == 1]]] = True
        return on_boundary

    @property
    def unit(self) -> float:
        """The power of two by which lengths of rings are multiplied, so that no product of them
        overflows or underflows.

        1 where the largest absolute coordinate lies between 3e-39 and 3e38, or is zero.
        """
        largest = self._largest
        if largest == 0 or 1 / RANGE <= largest <= RANGE:
            return 1.0
        # At most 2^1023: the inverse of a subnormal number is no float64.
        return math.ldexp(1.0, min(-math.frexp(largest)[1], 1023))

    @property
    def rings(self) -> list:
        """Closed one-rings in batches of equal valence n: list of (vertices (m,), neighbours
        (n, m)), int32; a valence may have several batches.

        Neighbours run counter-clockwise seen from outside. Vertices whose triangles do not close to
        exactly one ring are in no batch.
        """
        return self.find_rings()

    def find_rings(self, threads: int = 1) -> list:
        """`rings`, found by `threads` threads at the first call."""
        if self._rings is None:
            from .corners import one_rings

            self._rings = one_rings(self.faces, len(self.vertices), threads)
        return self._rings

    def find_adjacency(self, threads: int = 1):
        """The `curvlib.meshes.neighbourhoods.Adjacency`, found by `threads` threads at the first
        call."""
        if self._adjacency is None:
            from .neighbourhoods import adjacency

            self._adjacency = adjacency(self.faces, len(self.vertices), threads)
        return self._adjacency

    @cached_property
    def mean_edge(self) -> float:
        """Mean length of the edges, in the unit of the mesh."""
        from .neighbourhoods import mean_edge

        return mean_edge(self)

    @cached_property
    def closed(self) -> np.ndarray:
        """(V,) bool: the triangles around the vertex close to exactly one ring."""
        closed = np.zeros(len(self.vertices), dtype=bool)
        for vertices, _ in self.rings:
            closed[vertices] = True
        return closed


def _field(name, value, shape, copy):
    """A field of a mesh, checked and read only; None where `value` is None."""
    if value is None:
        return None
    if name in FLAGS:
        array = any_array(name, value)
        if array.dtype != bool:
            raise InputError(f"{name}: an array of bool is expected, not {array.dtype}")
    else:
        array = numbers(name, value, float, copy)
    if array.shape != shape:
        raise InputError(f"{name}: shape {array.shape}, expected {shape}")
    if name == "normals":
        squares = (array * array).sum(1)
        other = np.abs(squares - 1) > UNIT
        if other.any():
            with np.errstate(invalid="ignore", divide="ignore"):
                scaled = array / np.sqrt(squares)[:, None]
            array = np.where(other[:, None], scaled, array)
    return frozen(array)
