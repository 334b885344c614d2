"""Estimates on a mesh: gather one-rings in blocks that stay in cache, call the estimator, scatter
its values."""

import functools
import inspect
import threading
from collections.abc import Hashable
from numbers import Integral
from typing import get_args

import numpy as np

from .catalogue import estimators
from .errors import InputError, check_name
from .estimates import Estimates, warn_of_undefined
from .kit.batch import gather, scatter
from .kit.options import as_options
from .kit.tensor import Curvatures
from .meshes.exchange import as_mesh
from .parallel import for_each

# Ring slots (valence times vertices) per block: an array of a block takes 192 KiB.
BLOCK = 24576
OURS = f"{estimators.package}."
# Power of 1/length that each quantity scales with.
POWERS = {"K": 2, "H": 1, "k1": 1, "k2": 1, "d1": 0, "d2": 0}

# Valid names of an estimator's first parameter, which say what it is given.
GIVEN = ("ring", "mesh")
# Parameters of `estimate` itself: no option can have such a name.
RESERVED = ("mesh", "estimator", "threads")


def readings(estimator) -> dict[str, tuple]:
    """The options of an estimator: name -> valid values, the default first.

    Raises InputError for a parameter without a default or with the name of one of `estimate`'s.
    """
    return dict(_options(*_resolved(estimator)))


def _resolved(estimator):
    """Name and function of an estimator: a name, a path, or the function itself."""
    if callable(estimator) and isinstance(estimator, Hashable):
        return getattr(estimator, "__name__", "estimate"), estimator
    return estimator, estimators.module(estimator).estimate


@functools.cache
def _options(name, function):
    try:
        parameters = list(inspect.signature(function).parameters.values())
    except ValueError as error:  # of a builtin
        raise InputError(f"estimator {name!r}: {error}") from None
    given, others = parameters[:1], parameters[1:]
    if not given or given[0].kind not in (given[0].POSITIONAL_ONLY, given[0].POSITIONAL_OR_KEYWORD):
        raise InputError(f"estimator {name!r}: its first parameter has to be {' or '.join(GIVEN)}")
    check_name("first parameter", given[0].name, GIVEN, f"estimator {name!r}")
    options = {}
    for p in others:
        if p.kind != p.POSITIONAL_OR_KEYWORD or p.default is p.empty:
            raise InputError(f"estimator {name!r}: option {p.name!r} has no default")
        if p.name in RESERVED:
            raise InputError(f"estimator {name!r}: no option can be called {p.name!r}; rename it")
        values = get_args(p.annotation)
        options[p.name] = (p.default, *(v for v in values if v != p.default))
    return options


def _chosen(name, function, options):
    """All options of an estimator, defaults included: Numba compiles anew for each set of keywords.

    Raises InputError for an unknown option or value.
    """
    known = _options(name, function)
    for option, value in options.items():
        check_name(f"option of {name}", option, known)
        check_name(f"{option} of {name}", value, known[option])
    return {option: values[0] for option, values in known.items()} | options


def estimate(mesh, estimator, threads: int = 1, **options):
    """Estimate curvature at the vertices of a triangle mesh.

    Parameters
    ----------
    mesh : Mesh, (vertices, faces), or a mesh of another library
        Arrays (V, 3) and (F, 3), a mesh of trimesh or meshio, or an object that pyvista wraps into
        a triangle mesh. Its point normals are the exact normals of `normal="exact"`.
    estimator : str, path, callable, or a list of them
        A name in `curvlib.estimators()`, the path of a .py file like those in
        `curvlib/estimators`, or a function with the signature of their `estimate`. The estimators
        of a list share the rings.
    threads : int
        Number of threads; values do not depend on it.
    **options
        Options of the estimator, its readings; of a list, each member has to know them.

    Returns
    -------
    Estimates, or dict
        Pointwise, H = +1 on the unit sphere with outward normals. For a list, a dict from its
        members to Estimates. NaN at boundary vertices, at vertices whose triangles do not close to
        one ring (non-manifold or inconsistently oriented), and where the estimator has no finite
        value; `Estimates.undefined` counts them by cause.

    Raises
    ------
    InputError
        Unknown estimator or option, no triangle mesh, or an estimator that does not return
        curvatures.

    Warns
    -----
    MeshWarning
        More than half of the vertices have no value, some vertices coincide, or float32
        coordinates are coarse beside the edges.

    Examples
    --------
    >>> import curvlib
    >>> tetrahedron = (
    ...     [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]],
    ...     [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]],
    ... )
    >>> curvlib.estimate(tetrahedron, "gauss_bonnet").K.round(4)
    array([0.9069, 0.9069, 0.9069, 0.9069])
    """

    _keep_pages()
    mesh = as_mesh(mesh)
    if not isinstance(threads, Integral) or threads < 1:
        raise InputError(f"threads: {threads!r} is not a number of at least 1")
    several = isinstance(estimator, (list, tuple))
    found, of_mesh, of_ring = {}, [], []
    for each in estimator if several else [estimator]:
        name, function = _resolved(each)
        chosen = as_options(_chosen(name, function, options))
        found[each] = _Found(name, len(mesh.vertices))
        task = (found[each], function, chosen)
        (of_mesh if takes_mesh(function) else of_ring).append(task)

    def store(given, at, start, end, tasks, unit):
        # NumPy's error state is per thread.
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            for target, function, chosen in tasks:
                # A stranger's estimator gets a copy, lest others see what it writes to the ring.
                shared = given is mesh or getattr(function, "__module__", "").startswith(OURS)
                own = given if shared else type(given)(*map(np.copy, given))
                target.scatter(function(own, **chosen), at, start, end, unit)

    def work(block):
        (at, neighbours), start, end = block
        ring = gather(mesh.vertices, normals, at, neighbours, start, end, mesh.unit)
        store(ring, at, start, end, of_ring, mesh.unit)

    if of_mesh:
        every = np.arange(len(mesh.vertices), dtype=np.int32)
        store(mesh, every, 0, len(every), of_mesh, 1.0)
    if of_ring:
        normals = mesh.normals
        if normals is None:
            normals = np.empty((0, 3))
            normals.flags.writeable = False  # as those of a mesh: one type, compiled once
        rings = mesh.find_rings(threads)
        for_each(work, list(_blocks(rings)), threads)
        warn_of_undefined(mesh, sum(len(vertices) for vertices, _ in rings))
    results = {each: Estimates(mesh, target.arrays) for each, target in found.items()}
    return results if several else results[estimator]


class _Found:
    """The arrays that an estimator returned, by name, scattered to the vertices."""

    def __init__(self, name, count):
        self.name, self.count, self.arrays, self._lock = name, count, {}, threading.Lock()

    def scatter(self, returned, at, start, end, unit):
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


def takes_mesh(function) -> bool:
    """Whether an estimator takes the whole mesh instead of a batch of one-rings."""
    return next(iter(inspect.signature(function).parameters)) == "mesh"


def _blocks(rings):
    """Yield (batch, start, end): batches of one-rings, BLOCK slots at a time."""
    for batch in rings:
        vertices, neighbours = batch
        # An odd multiple of a cache line: rows of an array fall into different cache sets.
        step = BLOCK // len(neighbours) // 16 * 16 + 8
        for start in range(0, len(vertices), step):
            yield batch, start, min(start + step, len(vertices))


@functools.cache
def _keep_pages():
    """Freeing one 31 MiB block raises glibc's mmap threshold. Temporary arrays then come from the
    heap instead of fresh pages that the kernel has to zero."""
    np.empty(31 << 20, dtype=np.uint8)
