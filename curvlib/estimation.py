"""Estimates on a mesh: one-rings in cache-sized chunks through an estimator's file."""

import inspect
from collections import namedtuple
from concurrent.futures import ThreadPoolExecutor
from typing import get_args

import numpy as np

from .catalogue import estimators
from .errors import InputError, check_name
from .mesh import as_mesh
from .ring import Ring

Estimates = namedtuple("Estimates", "K H")
Estimates.__doc__ = """Pointwise estimates K and H, (V,) float64 each; NaN where undefined."""

# Ring slots (valence times vertices) per chunk: some dozens of arrays of 512 KiB stay in cache.
# Several threads take twice as many, so that they wait less for Python's lock.
CHUNK = 65536
# Having seen a block of this size freed, glibc's malloc takes no more of such a size from the
# system and gives none back: every temporary array would otherwise be new pages, to be zeroed.
np.empty(31 << 20, dtype=np.uint8)


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
    mesh = as_mesh(mesh)
    if threads < 1:
        raise InputError(f"threads: {threads!r} is not a number of at least 1")
    several = isinstance(estimator, (list, tuple))
    results, of_mesh, of_ring = {}, [], []
    for name in estimator if several else [estimator]:
        check_options(name, options)
        results[name] = Estimates(*np.full((2, len(mesh.vertices)), np.nan))
        function = estimators.module(name).estimate
        whole_mesh = next(iter(inspect.signature(function).parameters)) == "mesh"
        (of_mesh if whole_mesh else of_ring).append((function, results[name]))

    def store(given, at, functions):
        # Set here, since threads do not take it over from their caller.
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            for function, result in functions:
                for target, value in zip(result, function(given, **options)):
                    if value is not None:
                        # The one place where undefined becomes NaN.
                        target[at] = np.where(np.isfinite(value), value, np.nan)

    store(mesh, slice(None), of_mesh)
    coordinates = np.ascontiguousarray(mesh.vertices.T)
    normals = None if mesh.normals is None else np.ascontiguousarray(mesh.normals.T)

    def work(chunk):
        at, neighbours = chunk
        # The first neighbour once more behind the last: what follows is a view.
        neighbours = neighbours.astype(np.intp)
        e = np.empty((3, len(neighbours) + 1, len(at)))
        for x, ex in zip(coordinates, e):
            # mode="clip": "raise" writes to a copy first.
            x.take(neighbours, out=ex[:-1], mode="clip")
            ex[:-1] -= x.take(at)
        e[:, -1] = e[:, 0]
        ring = Ring(e[:, :-1], None if normals is None else normals[:, at], e[:, 1:])
        store(ring, at, of_ring)

    with ThreadPoolExecutor(threads) as pool:
        # A thread to wait for is what a small mesh would spend most of its time on.
        apply = pool.map if threads > 1 else map
        if of_ring:
            size = CHUNK if threads == 1 else 2 * CHUNK
            list(apply(work, _chunks(mesh.find_rings(apply), size)))
    return results if several else results[estimator]


def _chunks(rings, size):
    """Yield (vertices (m,), neighbours (n, m)) over closed one-rings, `size` slots at a time."""
    for vertices, neighbours in rings:
        step = max(1, size // len(neighbours))
        for start in range(0, len(vertices), step):
            yield vertices[start : start + step], neighbours[:, start : start + step]
