"""Triangle meshes: validation, boundary, and ordered one-rings in batches of equal valence."""

from functools import cached_property

import numpy as np

from .errors import InputError

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
        bad = ~np.isfinite(self.vertices).all(1)
        if bad.any():
            raise InputError(
                f"vertices: vertex {np.argmax(bad)} has a coordinate that is not finite"
            )
        bad = ((self.faces < 0) | (self.faces >= count)).any(1)
        if bad.any():
            row = int(np.argmax(bad))
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

    @property
    def H2(self):
        """H^2, (V,), which the paper's library holds; None without H."""
        return None if self.H is None else self.H * self.H

    @cached_property
    def _twins(self):
        """For half-edge 3 f + k, from corner k of face f to the next: the opposite half-edge,
        -1 on a boundary edge, -2 where an edge has more than two faces or two of one direction."""
        start, end = self.faces.ravel(), np.roll(self.faces, -1, axis=1).ravel()
        key = np.minimum(start, end) * len(self.vertices) + np.maximum(start, end)
        order = np.argsort(key, kind="stable")
        first = np.flatnonzero(np.diff(key[order], prepend=-1))
        count = np.diff(first, append=len(order))
        twins = np.full(len(order), -2)
        twins[order[first[count == 1]]] = -1
        a, b = order[first[count == 2]], order[first[count == 2] + 1]
        a, b = (h[start[a] == end[b]] for h in (a, b))
        twins[a], twins[b] = b, a
        return twins

    @cached_property
    def boundary(self):
        """(V,) bool: the vertex lies on an edge of one face only."""
        on_boundary = np.zeros(len(self.vertices), dtype=bool)
        edges = np.flatnonzero(self._twins == -1)
        on_boundary[self.faces.ravel()[edges]] = True
        on_boundary[np.roll(self.faces, -1, axis=1).ravel()[edges]] = True
        return on_boundary

    @cached_property
    def rings(self):
        """Closed one-rings by valence n: list of (vertices (m,), neighbours (n, m)), n rising.

        Neighbours run counter-clockwise. Vertices whose triangles do not close to exactly one
        cycle are in no batch.
        """
        start, end = self.faces.ravel(), np.roll(self.faces, -1, axis=1).ravel()
        # The half-edge from v to the neighbour after this one: across the edge that ends at v.
        before = np.arange(len(start)).reshape(-1, 3)[:, [2, 0, 1]].ravel()
        turn = self._twins[before]
        valence = np.bincount(start, minlength=len(self.vertices))
        broken = np.zeros(len(self.vertices), dtype=bool)
        broken[start[turn < 0]] = True
        outgoing = np.zeros(len(self.vertices), dtype=np.intp)
        outgoing[start[::-1]] = np.arange(len(start))[::-1]
        batches = []
        for n in np.unique(valence[~broken & (valence >= 3)]):
            vertices = np.flatnonzero((valence == n) & ~broken)
            neighbours = np.empty((n, len(vertices)), dtype=np.intp)
            first = edge = outgoing[vertices]
            one_cycle = np.ones(len(vertices), dtype=bool)
            for k in range(n):
                neighbours[k] = end[edge]
                edge = turn[edge]
                one_cycle &= (edge == first) == (k == n - 1)
            if not one_cycle.all():
                vertices, neighbours = vertices[one_cycle], neighbours[:, one_cycle]
            if len(vertices):
                batches.append((vertices, neighbours))
        return batches


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
