"""Passes over the vertices of a mesh: gather rings, disks or balls in blocks that stay in cache,
call estimators, scatter their values."""

import threading

import numpy as np

from .catalogue import estimators
from .errors import InputError
from .kit.batch import gather, scatter
from .kit.tensor import Curvatures
from .meshes.around import BALL, DISK, GEODESIC, WIDEST, Reach
from .meshes.facets import facets
from .meshes.loops import Neighbourhoods
from .parallel import for_each

# Ring slots (valence times vertices) per block: an array of a block takes 192 KiB.
BLOCK = 24576
OURS = f"{estimators.package}."
# Power of 1/length that each quantity scales with.
POWERS = {"K": 2, "H": 1, "k1": 1, "k2": 1, "d1": 0, "d2": 0}


class Task:
    """An estimator with its options, and the arrays that it returned, scattered to the vertices.

    `per`: "vertex", or "face" where the estimator is run over the centres of triangles.
    """

    def __init__(self, signature, options, mesh, per):
        self.name, self.function = signature.name, signature.function
        self.given, self.per = signature.given, per
        self.ours = getattr(self.function, "__module__", "").startswith(OURS)
        self.arrays, self._lock = {}, threading.Lock()
        self.count = len(mesh.vertices if per == "vertex" else mesh.faces)
        self.signature, self.chosen = signature, signature.chosen(options)

    def arguments(self, mesh, unit=1.0) -> dict:
        """The options as the estimator takes them."""
        return self.signature.arguments(self.chosen, mesh, unit)

    def store(self, returned, at, start, end, unit):
        """Scatter the values returned for the vertices at[start:end]; `unit` as in `gather`."""
        for name, values in zip(self._names(returned), returned):
            if values is None:
                continue
            values = self._checked(name, values, end - start)
            target = self.arrays.get(name)
            if target is None:
                target = self._target(name, values.ndim)
            if values.ndim == 1:
                scatter(values, at, start, target, unit, POWERS[name])
            else:
                for component, column in zip(values, target.T):
                    scatter(component, at, start, column, unit, POWERS[name])

    def _target(self, name, dimensions):
        with self._lock:  # the first block to finish allocates
            if name not in self.arrays:
                shape = (self.count, 3) if dimensions == 2 else self.count
                self.arrays[name] = np.full(shape, np.nan)
        return self.arrays[name]

    def _names(self, returned):
        """The names of the values that were returned; InputError where they are something else."""
        names = getattr(returned, "_fields", ("K", "H"))
        known = isinstance(returned, tuple) and names in (("K", "H"), Curvatures._fields)
        if not known or len(returned) != len(names):
            raise InputError(
                f"estimator {self.name!r} has to return K and H, not {type(returned).__name__}; "
                "or curvlib.kit.tensor.Curvatures"
            )
        return names

    def _checked(self, name, values, count):
        """The array (count,), or (3, count) of a direction; InputError for anything else."""
        expected = (3, count) if name in ("d1", "d2") else (count,)
        try:
            found = np.asarray(values)
        except ValueError as error:
            raise InputError(f"estimator {self.name!r}: {name}: {error}") from None
        if found.shape != expected or found.dtype.kind not in "biuf":
            raise InputError(
                f"estimator {self.name!r} returned an array of shape {found.shape} of "
                f"{found.dtype} as {name}, expected {expected} of float64"
            )
        return np.asarray(found, dtype=float, order="C")


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
        elif task.given == "mesh":
            every = np.arange(task.count, dtype=np.int32)
            with _quietly():
                task.store(_of_mesh(mesh, task), every, 0, len(every), 1.0)


def _of_mesh(mesh, task):
    """What an estimator of the mesh returns; InputError where a library is missing that its file
    says it requires."""
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
    return Reach(
        centres, offsets, neighbours, stars, normals, areas, mesh.unit, 1, np.inf, False, None
    )


def _around(graph, signature, options):
    """The disks or balls that options ask for: `radius`, else `rings`, else one ring."""
    kind = BALL if signature.given == "ball" else GEODESIC if signature.geodesic else DISK
    radius, rings = options.get("radius", np.inf) / graph.unit, options.get("rings", 1)
    return Neighbourhoods(
        kind, graph._replace(rings=rings, radius=radius, geodesic=signature.geodesic)
    )


def _field(mesh, graph, signature, chosen, threads):
    """The field (V, c) of a signature, None if it takes none; NaN where there is no ring or disk.

    It gets those of the chosen options that it has, and its own defaults for others.
    """
    beside = signature.field
    if beside is None:
        return None
    shared = beside.chosen({x: chosen[x] for x in beside.options if x in chosen})
    options = beside.arguments(shared, mesh, mesh.unit)
    field = _field(mesh, graph, beside, shared, threads)
    if beside.given in ("disk", "ball"):
        graph = _graph(mesh, "vertex", threads) if graph is None else graph
        around = _around(graph, beside, options)
        solved = around.solution if beside.coupled else around.field
        return solved(beside.function, tuple(options.values()), field, threads)
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
