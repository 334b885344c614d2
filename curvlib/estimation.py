"""Estimates on a mesh: one-rings in cache-sized chunks through an estimator's file."""

import inspect
from collections import namedtuple
from typing import get_args

import numpy as np

from .catalogue import estimators
from .errors import check_name
from .mesh import as_mesh
from .ring import Ring

Estimates = namedtuple("Estimates", "K H")
Estimates.__doc__ = """Pointwise estimates K and H, (V,) float64 each; NaN where undefined."""

# Ring slots (valence times vertices) per chunk: some dozens of arrays of 64 KiB stay in cache.
CHUNK = 4096


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
    known = readings(estimator)
    for option, value in options.items():
        check_name(f"option of {estimator}", option, known, where)
        check_name(f"{option} of {estimator}", value, known[option], where)


def estimate(mesh, estimator: str, **options) -> Estimates:
    """K and H at the vertices of a triangle mesh, pointwise; H = +1 on the unit sphere.

    `mesh`: a Mesh, a pair (vertices (V, 3), faces (F, 3)) or whatever pyvista wraps into a
    triangle mesh. `estimator`: a name from `estimators()` or the path of a file like those.
    `options`: the estimator's readings.

    NaN at boundary vertices, where the triangles around a vertex do not close to one ring
    (non-manifold or inconsistently oriented), and wherever an estimator comes to no finite
    value; an estimator of one quantity leaves the other NaN.

    Raises InputError for an unknown estimator or option and for what is no triangle mesh.
    """
    mesh = as_mesh(mesh)
    check_options(estimator, options)
    function = estimators.module(estimator).estimate
    result = Estimates(*np.full((2, len(mesh.vertices)), np.nan))
    whole_mesh = next(iter(inspect.signature(function).parameters)) == "mesh"
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        if whole_mesh:
            _store(result, slice(None), function(mesh, **options))
        else:
            for at, ring in rings(mesh):
                _store(result, at, function(ring, **options))
    return result


def rings(mesh):
    """Yield (vertex indices (m,), Ring) over all closed one-rings, in chunks of one valence."""
    coordinates = np.ascontiguousarray(mesh.vertices.T)
    normals = None if mesh.normals is None else np.ascontiguousarray(mesh.normals.T)
    for vertices, neighbours in mesh.rings:
        step = max(1, CHUNK // len(neighbours))
        for start in range(0, len(vertices), step):
            at = vertices[start : start + step]
            e = coordinates.take(neighbours[:, start : start + step], axis=1)
            e -= coordinates.take(at, axis=1)[:, None]
            yield at, Ring(e, None if normals is None else normals[:, at])


def _store(result, at, values):
    """The one place where undefined becomes NaN."""
    for target, value in zip(result, values):
        if value is not None:
            target[at] = np.where(np.isfinite(value), value, np.nan)
