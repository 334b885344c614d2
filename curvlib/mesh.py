"""Triangle meshes: validation, boundary, and ordered one-rings in batches of equal valence."""

from functools import cached_property

import numpy as np

from .errors import InputError

# Corners per chunk of the walk around vertices: a few arrays of 256 KiB stay in cache.
CHUNK = 65536
# From this valence on neighbours are matched by sorting: at most 256, since slots are bytes.
SORTED = 64

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
}


class Mesh:
    """A triangle mesh, with exact values at its vertices where it was made from a surface.

    `vertices` (V, 3) float64, `faces` (F, 3) int, counter-clockwise seen from outside.
    Optional, else None: `uv` (V, 2), `normals` (V, 3) unit, `K`, `H`, `k1`, `k2` (V,) exact
    and pointwise, their directions `d1`, `d2` (V, 3) unit, `smooth` (V,) bool.

    Raises InputError where an array has the wrong shape, a coordinate is not finite or a face
    refers to no vertex.
    """

    def __init__(self, vertices, faces, **fields):
        self.vertices = np.ascontiguousarray(vertices, dtype=float)
        faces = np.asarray(faces)
        if faces.size and not np.issubdtype(faces.dtype, np.integer):
            raise InputError(f"faces: indices have to be integers, not {faces.dtype}")
        self.faces = np.ascontiguousarray(faces, dtype=np.intp)
        _check_rows("vertices", self.vertices, 3)
        _check_rows("faces", self.faces, 3)
        count = len(self.vertices)
        bad = ~np.isfinite(self.vertices)
        if bad.any():
            raise InputError(
                f"vertices: vertex {np.argmax(bad) // 3} has a coordinate that is not finite"
            )
        bad = self.faces.view(np.uintp) >= count  # a negative one is large without its sign
        if bad.any():
            row = int(np.argmax(bad)) // 3
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
        """Closed one-rings by valence n: list of (vertices (m,), neighbours (n, m)), n rising.

        Neighbours run counter-clockwise. Vertices whose triangles do not close to exactly one
        cycle are in no batch.
        """
        return self.find_rings()

    def find_rings(self, apply=map):
        """`rings`, by an `apply` that may call the function on several chunks at a time."""
        if "rings" in self.__dict__:
            return self.rings
        first, corners = self._corners(apply)
        valence = np.diff(first)
        batches, todo = [], []
        for n in np.flatnonzero(np.bincount(valence)):
            if n < 3:
                continue
            vertices = np.flatnonzero(valence == n)
            neighbours = np.empty((n, len(vertices)), dtype=np.int32)
            closed = np.empty(len(vertices), dtype=bool)
            batches.append((vertices, neighbours, closed))
            step = max(1, CHUNK // n)
            for start in range(0, len(vertices), step):
                part = slice(start, start + step)
                todo.append((first[vertices[part]], neighbours[:, part], closed[part]))

        def walk(chunk):
            at, neighbours, closed = chunk
            at_v = corners.take(at + np.arange(len(neighbours))[:, None])
            neighbours[:], closed[:] = _walk(at_v)

        list(apply(walk, todo))
        self.__dict__["rings"] = [
            (vertices, neighbours) if closed.all() else (vertices[closed], neighbours[:, closed])
            for vertices, neighbours, closed in batches
            if closed.any()
        ]
        return self.rings

    def _corners(self, apply):
        """Where each vertex's corners begin (V + 1,), and the corners (3 F,), vertex by vertex:
        the two int32 vertices that follow the corner's own in its face, packed into an int64."""
        # Imported here, since it takes longer than importing all of curvlib.
        from scipy.sparse import csr_array

        count = len(self.faces)
        faces = np.empty((count, 3), dtype=np.int32)
        others = np.empty((count, 3), dtype=np.int64)

        def pack(start):
            part = slice(start, start + CHUNK)
            faces[part] = self.faces[part]
            pairs = others[part].view(np.int32)
            faces[part].take((1, 2, 2, 0, 0, 1), axis=1, out=pairs, mode="clip")

        list(apply(pack, range(0, count, CHUNK)))
        # Its conversion to columns is a counting sort, by int32 indices twice as fast.
        indptr = np.arange(0, 3 * count + 1, 3, dtype=np.int32)
        rows = (others.ravel(), faces.ravel(), indptr)
        columns = csr_array(rows, shape=(count, len(self.vertices))).tocsc()
        return columns.indptr, columns.data


def _walk(corners):
    """Neighbours (n, m) in the order of a walk around each vertex, and (m,) bool whether it came
    by all n corners (n, m) and back."""
    n, m = corners.shape
    here, there = corners.view(np.int32).reshape(n, m, 2).transpose(2, 0, 1).copy()
    after, closed = (_compared if n < SORTED else _sorted)(here, there)
    # From slots of each column to places in the whole array.
    after = after * np.intp(m)
    after += np.arange(m)
    walk = np.empty((n, m), dtype=np.intp)
    walk[0] = start = np.arange(m)
    for k in range(1, n):
        after.take(walk[k - 1], out=walk[k], mode="clip")
        closed &= walk[k] != start
    closed &= after.take(walk[-1]) == start
    return here.take(walk), closed


def _compared(here, there):
    """The slot of `here` (n, m) where each of `there` (n, m) is found in the same column, the
    last if there are several, and (m,) bool whether all are found.

    All are compared with all, in bytes.
    """
    after = np.zeros(here.shape, dtype=np.uint8)
    found = np.empty(here.shape, dtype=bool)
    slot = found.view(np.uint8)
    for k, vertex in enumerate(here):
        np.equal(there, vertex, out=found)
        slot *= np.uint8(k + 1)
        np.maximum(after, slot, out=after)
    return after - np.intp(1), (after > 0).all(0)


def _sorted(here, there):
    """As `_compared`, in less time where n is large: the sorted ones are the same."""
    by_here, by_there = here.argsort(0), there.argsort(0)
    after = np.empty_like(by_here)
    np.put_along_axis(after, by_there, by_here, 0)
    same = np.take_along_axis(here, by_here, 0) == np.take_along_axis(there, by_there, 0)
    return after, same.all(0)


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
