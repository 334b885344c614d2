"""Errors by the distance to the boundary; and an attempt to lower them there."""

from typing import Literal

import numpy as np
import pandas as pd

from curvlib.estimation import estimate
from curvlib.estimators.compact_hermite import SINE, SLOPE
from curvlib.kit.compiled import kernel
from curvlib.kit.disk import given_normal as given_normal
from curvlib.kit.hermite import fit_hermite
from curvlib.kit.tensor import from_graph
from curvlib.kit.vectors import at, tangents
from curvlib.meshes.mesh import Mesh

from .frontier import NEW, REFERENCE
from .references import principal_axes

LAYERS = 6


@kernel
def settled(disk, given_normal, degree: Literal[6, 5, 4] = 6, rings: Literal[3, 2] = 3):
    """A polynomial fitted to the heights of the neighbours and, weighted as in `compact_hermite`,
    to the slopes of the normals that the mesh has."""
    N = at(given_normal, 0)
    X, Y = tangents(N)
    f, _, _ = fit_hermite(disk, given_normal, X, Y, N, degree, SLOPE, SINE)
    return from_graph(*f, X, Y, N)[0]


def layers(mesh) -> np.ndarray:
    """The distance (V,) of each vertex from the boundary in edges, at most LAYERS."""
    found = np.where(mesh.boundary, 0, LAYERS)
    for layer in range(1, LAYERS):
        near = np.isin(mesh.faces, np.flatnonzero(found == layer - 1)).any(1)
        beside = np.unique(mesh.faces[near])
        found[beside] = np.minimum(found[beside], layer)
    return found


def over_square(mesh, threads: int = 1) -> pd.DataFrame:
    """map.csv: `x`, `y` and the `error` of K of three estimators at the vertices of a graph."""
    rows = []
    chosen = [c for c in NEW if str(c) in ("compact_hermite", "jet(degree=6, rings=3)")]
    calls = [(REFERENCE, principal_axes, {"degree": 4, "rings": 3})]
    for name, what, options in calls + [(str(c), c.estimator, c.options) for c in chosen]:
        found = estimate(mesh, what, threads, **options)
        x, y, _ = mesh.vertices.T
        error = np.abs(found.K - mesh.K)
        rows.append(pd.DataFrame({"estimator": name, "x": x, "y": y, "error": error}))
    return pd.concat(rows, ignore_index=True)


def boundary(meshes, threads: int = 1) -> pd.DataFrame:
    """boundary.csv: mean errors by distance from the boundary.

    Parameters
    ----------
    meshes : dict
        (surface, kind, n) -> open Mesh with exact values.
    threads : int

    Returns
    -------
    DataFrame
        Per mesh, `estimator`, `layer` (edges from the boundary; LAYERS and more are one) and
        quantity (K, H) the mean error `value` over its `vertices`. `settled` fits polynomials to
        the normals of `compact_hermite` once it has come to rest, at the boundary too.
    """
    rows = []
    calls = [(str(call), call.estimator, call.options) for call in NEW[1:]]
    calls.append((REFERENCE, principal_axes, {"degree": 4, "rings": 3}))
    for key, mesh in meshes.items():
        labels, layer = dict(zip(("surface", "kind", "n"), key)), layers(mesh)
        every = {name: estimate(mesh, what, threads, **options) for name, what, options in calls}
        normals = np.cross(every["compact_hermite"].d1, every["compact_hermite"].d2)
        known = Mesh(mesh.vertices, mesh.faces, normals=normals)
        every["settled"] = estimate(known, settled, threads)
        for name, found in every.items():
            for quantity in ("K", "H"):
                error = np.abs(getattr(found, quantity) - getattr(mesh, quantity))
                for k in range(LAYERS + 1):
                    there = layer == k
                    row = {"estimator": name, "layer": k, "quantity": quantity}
                    row |= {"value": np.nanmean(error[there]), "vertices": there.sum()}
                    rows.append(labels | row)
    return pd.DataFrame(rows)
