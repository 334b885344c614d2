"""Passes over the vertices of a mesh: gather rings, disks or balls in blocks that stay in cache,
call estimators, scatter their values."""

from functools import cached_property

import numpy as np

from .errors import InputError
from .kit.batch import gather
from .meshes.around import BALL, DISK, GEODESIC, WIDEST, Reach
from .meshes.facets import facets
from .meshes.loops import Neighbourhoods
from .meshes.mesh import Mesh
from .meshes.neighbourhoods import BROKEN, CLOSED
from .parallel import for_each
from .signatures import Signature

# Ring slots (valence times vertices) per block: an array of a block takes 192 KiB.
BLOCK = 24576
# The disks of more vertices than this part of all read a field nearly everywhere.
MANY = 0.2
# Sweeps of `Passes.sums` behind the last, where there is nothing.
FURTHER = 4


def run(mesh, tasks, threads) -> None:
    """Call each task's estimator with all rings, disks, balls or the mesh, and store what it
    returns."""
    of_rings = [task for task in tasks if task.given == "ring"]
    if of_rings:
        _over_rings(mesh, of_rings, threads)
    for task in tasks:
        if task.given in ("disk", "ball"):
            graph, options = _graph(mesh, task.per, threads), task.arguments(mesh, mesh.unit)
            field = _field(mesh, graph, task.signature, task.chosen, threads)
            around = _around(graph, task.signature, options)
            task.arrays = around.estimates(task.function, tuple(options.values()), field, threads)
        elif task.given in ("mesh", "passes"):
            every = np.arange(task.count, dtype=np.int32)
            with _quietly():
                if task.given == "mesh":
                    returned, unit = _of_mesh(mesh, task), 1.0
                else:
                    options, unit = task.arguments(mesh, mesh.unit), mesh.unit
                    returned = task.function(Passes(mesh, threads), **options)
                task.store(returned, every, 0, len(every), unit)


class Passes:
    """What an estimator is given that makes passes of its own: it runs functions of disks and balls
    at all vertices or some, and sees their values before it chooses the next.

    Coordinates, lengths and values are in the unit of disks. Functions are written like
    `estimate(disk, ...)`, fields and options included.

    Attributes
    ----------
    vertices : (V, 3)
    centres : (m,) int32
        The vertices that have a disk.
    """

    def __init__(self, mesh, threads):
        adjacency = mesh.find_adjacency(threads)
        if mesh.unit != 1:
            mesh = Mesh(mesh.vertices * mesh.unit, mesh.faces, normals=mesh.normals)
            mesh._adjacency = adjacency
        self._mesh, self._threads = mesh, threads
        self._graph, self.vertices = _graph(mesh, "vertex", threads), mesh.vertices
        self.centres = np.flatnonzero(adjacency.stars != BROKEN).astype(np.int32)

    def moved(self, vertices):
        """Passes over the mesh with its vertices at other places."""
        return Passes(self._mesh.moved(vertices), self._threads)

    @property
    def mean_edge(self):
        """The mean length of an edge."""
        return self._mesh.mean_edge

    def edges(self):
        """The root mean square length of the edges at each vertex, (V,)."""
        offsets, neighbours = self._graph.offsets, self._graph.neighbours
        each = np.repeat(self.vertices, np.diff(offsets), axis=0) - self.vertices[neighbours]
        squares = np.concatenate(([0.0], np.cumsum((each**2).sum(1))))
        return np.sqrt(np.diff(squares[offsets]) / np.maximum(np.diff(offsets), 1))

    def layers(self, most):
        """How many edges each vertex is from the boundary, (V,), `most` where there are more."""
        near, found = self._near, np.full(len(self.vertices), most)
        there = self._graph.stars != CLOSED
        for k in range(most):
            found[there & (found == most)] = k
            there = near @ there > 0
        return found

    def sums(self, values, sweeps, groups):
        """Values (c, V), each replaced by the sum over its vertex and those neighbours that have
        its group, so many times; where the last component is 0 then, by that over all neighbours,
        a few times more. `groups`: (V,)."""
        every = self._near
        within = every.tocoo()
        within.data[groups[within.row] != groups[within.col]] = 0
        within, values = within.tocsr(), np.ascontiguousarray(values.T)
        for _ in range(sweeps):
            values = within @ values
        for _ in range(FURTHER):
            empty = np.flatnonzero(values[:, -1] == 0)
            if len(empty) in (0, len(values)):
                break
            values[empty] = every[empty] @ values
        return values.T

    @cached_property
    def _near(self):
        """The matrix of who is a vertex or its neighbour."""
        from scipy.sparse import csr_array, eye_array

        offsets, neighbours = self._graph.offsets, self._graph.neighbours
        count, ones = len(self.vertices), np.ones(len(neighbours))
        return csr_array((ones, neighbours, offsets), (count, count)) + eye_array(count)

    def estimates(self, function, vertices=None, **options) -> dict:
        """The values of an estimator at m vertices, all by default: name -> (m,), or (3, m) of a
        direction; empty where none of them has a disk."""
        signature, graph, field, given = self._prepared(function, vertices, options)
        around = _around(graph, signature, given)
        found = around.estimates(function, tuple(given.values()), field, self._threads)
        return {name: x.T for name, x in found.items()}

    def field(self, function, vertices=None, **options):
        """The components (c, m) that a function returns at m vertices, all by default; NaN where
        there is no disk, (0, m) where there is none at all."""
        signature, graph, field, given = self._prepared(function, vertices, options)
        around = _around(graph, signature, given)
        return around.field(function, tuple(given.values()), field, self._threads).T

    def equations(self, function, **options):
        """Of a function that returns Coupled the list of Equations (`curvlib.meshes.coupling`), and
        the components (c, V) where all unknowns are zero."""
        signature, graph, field, given = self._prepared(function, None, options)
        around = _around(graph, signature, given)
        blocks, own = around.equations(function, tuple(given.values()), field, self._threads)
        return blocks, own.T

    def _prepared(self, function, vertices, options):
        signature = Signature.of(function.__name__, function)
        chosen, graph = signature.chosen(options), self._graph
        if vertices is not None:
            graph = graph._replace(at=np.ascontiguousarray(vertices, np.int32))
        field = _field(self._mesh, graph, signature, chosen, self._threads)
        return signature, graph, field, signature.arguments(chosen, self._mesh, 1.0)


def _of_mesh(mesh, task):
    """What an estimator of the mesh returns; InputError where a library is missing that its file
    says it requires."""
    if mesh.left_out is not None and task.per == "vertex":
        # Other libraries know no triangles without corners and no positions that are not finite.
        position = mesh.vertices[mesh.faces[np.argmin(mesh.left_out), 0]]
        places = np.where(np.isnan(mesh.vertices), position, mesh.vertices)
        mesh = Mesh(places, mesh.faces[~mesh.left_out], copy=False, normals=mesh.normals)
    try:
        return task.function(mesh, **task.arguments(mesh))
    except ImportError as error:
        file = getattr(task.function, "__globals__", {})
        if "REQUIRES" not in file:
            raise
        remedy = file.get("INSTALL", "`make peers` installs it")
        raise InputError(
            f"estimator {task.name!r} needs {file['REQUIRES']}: {error}; {remedy}"
        ) from None


def _over_rings(mesh, tasks, threads):
    arguments = [task.arguments(mesh, mesh.unit) for task in tasks]
    fields = [_field(mesh, None, task.signature, task.chosen, threads) for task in tasks]

    def work(ring, at, neighbours, start, end):
        for task, options, field in zip(tasks, arguments, fields):
            # A stranger's estimator gets a copy, lest others see what it writes to the ring.
            own = ring if task.ours else type(ring)(*map(np.copy, ring))
            given = own, *_beside(field, at, neighbours, start, end)
            task.store(task.function(*given, **options), at, start, end, mesh.unit)

    _each_ring(mesh, work, threads)


def _each_ring(mesh, work, threads):
    """work(ring, at, neighbours, start, end) for blocks of the one-rings of at[start:end]."""
    normals = mesh.normals
    if normals is None:
        normals = np.empty((0, 3))
        normals.flags.writeable = False  # as those of a mesh: one type, compiled once

    def gathered(block):
        (at, neighbours), start, end = block
        ring = gather(mesh.vertices, normals, at, neighbours, start, end, mesh.unit)
        with _quietly():
            work(ring, at, neighbours, start, end)

    for_each(gathered, list(_blocks(mesh.find_rings(threads))), threads)


def _graph(mesh, per, threads):
    """The Reach of a mesh's vertices, or of the centres of its triangles, but for how far."""
    if per == "face":
        centres, normals, areas, offsets, neighbours, stars = facets(mesh, threads)
    else:
        centres, areas, normals = mesh.vertices, np.empty(0), mesh.normals
        normals = np.empty((0, 3)) if normals is None else normals
        offsets, neighbours, stars, _ = mesh.find_adjacency(threads)
    # Read only as the vertices of a mesh: one type, compiled once.
    centres, normals = centres.view(), normals.view()
    centres.flags.writeable = normals.flags.writeable = False
    at, unit = np.arange(len(centres), dtype=np.int32), mesh.unit
    return Reach(
        centres, offsets, neighbours, stars, normals, areas, unit, 1, np.inf, False, at, None
    )


def _around(graph, signature, options):
    """The disks or balls that options ask for: `radius`, else `rings`, else one ring."""
    kind = BALL if signature.given == "ball" else GEODESIC if signature.geodesic else DISK
    radius, rings = options.get("radius", np.inf) / graph.unit, options.get("rings", 1)
    return Neighbourhoods(
        kind, graph._replace(rings=rings, radius=radius, geodesic=signature.geodesic)
    )


def _field(mesh, graph, signature, chosen, threads):
    """The field (V, c) of a signature, None if it takes none; NaN where there is no ring or disk,
    and where the disks or balls of the vertices `graph.at` do not reach. Equations are solved at
    all vertices.

    It gets those of the chosen options that it has, and its own defaults for others.
    """
    beside = signature.field
    if beside is None:
        return None
    shared = beside.chosen({x: chosen[x] for x in beside.options if x in chosen})
    options = beside.arguments(shared, mesh, mesh.unit)
    if graph is None and beside.given in ("disk", "ball"):
        graph = _graph(mesh, "vertex", threads)
    some = graph is not None and len(graph.at) < MANY * len(graph.vertices)
    if some and not beside.coupled:
        own = signature.arguments(chosen, mesh, mesh.unit)
        graph = graph._replace(at=_around(graph, signature, own).reached(threads))
    elif graph is not None:
        graph = graph._replace(at=np.arange(len(graph.vertices), dtype=np.int32))
    field = _field(mesh, graph, beside, shared, threads)
    if beside.given in ("disk", "ball"):
        around = _around(graph, beside, options)
        if beside.coupled:
            return around.solution(beside.function, tuple(options.values()), field, threads)
        found = around.field(beside.function, tuple(options.values()), field, threads)
        if len(found) == len(graph.vertices):
            return found
        values = np.full((len(graph.vertices), found.shape[1]), np.nan)
        values[graph.at] = found
        return values
    found = []

    def work(ring, at, neighbours, start, end):
        given = ring, *_beside(field, at, neighbours, start, end)
        found.append((at[start:end], _components(beside, given, options, end - start)))

    _each_ring(mesh, work, threads)
    # Without rings it is not known how many components there are.
    components = len(found[0][1]) if found else WIDEST
    if any(len(x) != components for _, x in found):
        raise InputError(f"{beside.name!r} returns different numbers of components")
    values = np.full((len(mesh.vertices), components), np.nan)
    for vertices, x in found:
        values[vertices] = x.T
    return values


def _beside(field, at, neighbours, start, end):
    """The field (c, 1 + n, m) at the vertices of rings, or nothing where there is none."""
    if field is None:
        return ()
    index = np.vstack((at[start:end], neighbours[:, start:end]))
    return (np.ascontiguousarray(field.T[:, index]),)


def _components(beside, given, options, count):
    """The components (c, count) that a function of rings returns; InputError for anything else."""
    returned = beside.function(*given, **options)
    try:
        found = np.array(returned, dtype=float)
    except (TypeError, ValueError):
        found = np.empty(0)
    if found.ndim != 2 or found.shape[1] != count:
        raise InputError(f"{beside.name!r} has to return a tuple of arrays ({count},) of float64")
    if len(found) > WIDEST:
        raise InputError(f"{beside.name!r} has more than {WIDEST} components")
    return found


def _blocks(rings):
    """Yield (batch, start, end): batches of one-rings, BLOCK slots at a time."""
    for batch in rings:
        vertices, neighbours = batch
        # An odd multiple of a cache line: rows of an array fall into different cache sets.
        step = BLOCK // len(neighbours) // 16 * 16 + 8
        for start in range(0, len(vertices), step):
            yield batch, start, min(start + step, len(vertices))


def _quietly():
    """NumPy's error state is per thread."""
    return np.errstate(divide="ignore", invalid="ignore", over="ignore")
