"""Estimates on a mesh: one-rings, in blocks that stay in cache, through an estimator's file."""

import functools
import inspect
from collections import namedtuple
from typing import get_args

import numpy as np

from .catalogue import estimators
from .errors import InputError, check_name
from .mesh import as_mesh
from .parallel import for_each

Estimates = namedtuple("Estimates", "K H")
Estimates.__doc__ = """Pointwise estimates K and H, (V,) float64 each; NaN where undefined."""

# Ring slots (valence times vertices) per block: some dozens of arrays of 192 KiB.
BLOCK = 24576
# Having seen a block of this size freed, glibc's malloc takes no more of such a size from the
# system and gives none back: every temporary array would otherwise be new pages, to be zeroed.
np.empty(31 << 20, dtype=np.uint8)


@functools.cache
def readings(estimator: str) -> dict[str, tuple]:
    """The options of an estimator: name -> valid values, the default first."""
    parameters = list(inspect.signature(estimators.module(estimator).estimate).parameters.values())
    options = {}
    for p in parameters[1:]:
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

    Raises InputError for an unknown estimator or option and for what is no triangle mesh.
    """
    # Compiled code, which takes longer to import than all of curvlib.
    from .ring import around, spread

    mesh = as_mesh(mesh)
    if threads < 1:
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
                for target, values in zip(results[name], function(given, **chosen)):
                    if values is None:
                        continue
                    values = np.ascontiguousarray(values, dtype=float)
                    if values.shape != (end - start,):
                        raise InputError(
                            f"estimator {name!r} returned an array of shape {values.shape}, "
                            f"expected {(end - start,)}"
                        )
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
