"""Estimates on a mesh: one-rings, in blocks that stay in cache, through an estimator's file."""

import functools
import inspect
from collections import namedtuple
from numbers import Integral
from typing import get_args

import numpy as np

from curvlib.catalogue import estimators
from curvlib.errors import InputError, check_name
from curvlib.meshes.mesh import as_mesh
from curvlib.parallel import for_each

Estimates = namedtuple("Estimates", "K H")
Estimates.__doc__ = """Pointwise estimates K and H, (V,) float64 each; NaN where undefined."""

# Ring slots (valence times vertices) per block: some dozens of arrays of 192 KiB.
BLOCK = 24576
# Having seen a block of this size freed, glibc's malloc takes no more of such a size from the
# system and gives none back: every temporary array would otherwise be new pages, to be zeroed.
np.empty(31 << 20, dtype=np.uint8)


def readings(estimator: str) -> dict[str, tuple]:
    """The options of an estimator: name -> valid values, the default first.

    InputError where one of its parameters is no option with a default.
    """
    return dict(_options(estimators.module(estimator).estimate, estimator))


@functools.cache
def _options(function, estimator):
    options = {}
    for p in list(inspect.signature(function).parameters.values())[1:]:
        if p.kind != p.POSITIONAL_OR_KEYWORD or p.default is p.empty:
            raise InputError(f"estimator {estimator!r}: option {p.name!r} has no default")
        values = get_args(p.annotation)
        options[p.name] = (p.default, *(v for v in values if v != p.default))
    return options


def check_options(estimator: str, options: dict, where: str = "") -> None:
    """Raise InputError unless the estimator knows every option and its value."""
    known = readings(estimator) if options else {}
    for option, value in options.items():
        check_name(f"option of {estimator}", option, known, where)
        check_name(f"{option} of {estimator}", value, known[option], where)


def estimate(mesh, estimator, threads: int = 1, **options):
    """K and H at the vertices of a triangle mesh, pointwise; H = +1 on the unit sphere.

    `mesh`: a Mesh, a pair (vertices (V, 3), faces (F, 3)) or whatever pyvista wraps into a
    triangle mesh. `estimator`: a name from `estimators()` or the path of a file like those; for
    a list of them a dict of Estimates by name, and what they share is computed once. `options`:
    the readings, known to each of the estimators. `threads`: how many, which changes no value.

    NaN at boundary vertices, where the triangles around a vertex do not close to one ring
    (non-manifold or inconsistently oriented), and wherever an estimator comes to no finite
    value; an estimator of one quantity leaves the other NaN.

    Raises InputError for an unknown estimator or option, for what is no triangle mesh and for
    an estimator that does not return K and H.
    """
    from curvlib.kit.ring import around, spread

    mesh = as_mesh(mesh)
    if not isinstance(threads, Integral) or threads < 1:
        raise InputError(f"threads: {threads!r} is not a number of at least 1")
    several = isinstance(estimator, (list, tuple))
    results, of_mesh, of_ring = {}, [], []
    for name in estimator if several else [estimator]:
        check_options(name, options)
        results[name] = Estimates(*np.full((2, len(mesh.vertices)), np.nan))
        function = estimators.module(name).estimate
        # All of them, since each set of given ones would be compiled anew.
        chosen = {option: values[0] for option, values in readings(name).items()} | options
        task = (name, function, chosen)
        (of_mesh if takes_mesh(function) else of_ring).append(task)

    def store(given, at, start, end, tasks):
        # Set here, since threads do not take it over from their caller.
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            for name, function, chosen in tasks:
                found = function(given, **chosen)
                for target, values in zip(results[name], _checked(found, end - start, name)):
                    if values is not None:
                        spread(values, at, start, target)

    def work(block):
        (at, neighbours), start, end = block
        ring = around(mesh.vertices, normals, at, neighbours, start, end)
        store(ring, at, start, end, of_ring)

    if of_mesh:
        every = np.arange(len(mesh.vertices), dtype=np.int32)
        store(mesh, every, 0, len(every), of_mesh)
    if of_ring:
        known = mesh.normals if mesh.normals is not None else np.empty((0, 3))
        normals = np.ascontiguousarray(known, dtype=float)
        for_each(work, list(_blocks(mesh.find_rings(threads))), threads)
    return results if several else results[estimator]


def _checked(found, count, name):
    """K and H that an estimator returned, arrays (count,) or None; else InputError."""
    if not isinstance(found, tuple) or len(found) != 2:
        raise InputError(f"estimator {name!r} has to return K and H, not {type(found).__name__}")
    checked = [x if x is None else np.asarray(x, dtype=float, order="C") for x in found]
    for x in checked:
        if x is not None and x.shape != (count,):
            raise InputError(
                f"estimator {name!r} returned an array of shape {x.shape}, expected {(count,)}"
            )
    return checked


def takes_mesh(function) -> bool:
    """Whether an estimator takes the whole mesh instead of a batch of one-rings."""
    return next(iter(inspect.signature(function).parameters)) == "mesh"


def _blocks(rings):
    """Yield (batch, start, end): batches of one-rings, BLOCK slots at a time."""
    for batch in rings:
        vertices, neighbours = batch
        step = max(1, BLOCK // len(neighbours))
        for start in range(0, len(vertices), step):
            yield batch, start, min(start + step, len(vertices))
