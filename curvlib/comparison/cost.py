"""What fits cost beside a reference, in pairs of runs of one process; and what theirs is made of.

Times are those of the processor, on one thread: what else runs on the machine disturbs them least.
"""

import functools
import time
from typing import Literal

import numpy as np
import pandas as pd

from curvlib.catalogue import peers
from curvlib.estimation import estimate
from curvlib.estimators.compact_hermite import fitted, normals
from curvlib.kit.compiled import kernel
from curvlib.meshes.coupling import solve
from curvlib.meshes.mesh import Mesh
from curvlib.meshes.torus import torus
from curvlib.passes import Passes

from .calls import Call
from .frontier import NEW, PEERS, REFERENCE, installed
from .references import principal_axes
from .turns import in_turn

LIBIGL, OURS = "libigl gaussian_curvature", "gauss_bonnet"
RUNS, SECONDS = 7, 4.0  # a method is run until one of these is reached
# More than a thousand times the reference, at which one run of a large mesh takes minutes.
SLOW = ("trimesh_measures", "mymesh_cubic", "lapy_tensor")
CALLS = (
    Call("gauss_bonnet", {}),
    Call("quadric", {}),
    Call("jet", {}),
    *NEW,
    Call("jet", {"degree": 4, "rings": 3}),
    Call("ball_regression", {"radius": "3 edges"}),
    Call("ball_regression", {}),
)


def cost(side: int) -> pd.DataFrame:
    """cost.csv: the cost of estimators and of the peers that are installed.

    Parameters
    ----------
    side : int
        Of the irregular torus of side^2 vertices.

    Returns
    -------
    DataFrame
        Per `method` the `vertices`, `microseconds` a vertex (median), the `ratio` to `reference`
        (median of the ratios of runs in turn): libigl's call alone, or `gauss_bonnet` where libigl
        is not installed.
    """
    vertices, faces = torus(side, "irregular")
    there = [row.method for row in installed().itertuples() if row.installed]
    libigl = "libigl_defects" in there
    reference = LIBIGL if libigl else OURS
    against = peers.module("libigl_defects").returned if libigl else _run("gauss_bonnet", {})
    runs = {str(call): _run(call.estimator, call.options) for call in CALLS}
    runs[REFERENCE] = _run(principal_axes, {"degree": 4, "rings": 3})
    for name in there:
        if name not in SLOW:
            for options in ({}, *PEERS.get(name, ())):
                runs[str(Call(name, options))] = _run(name, options)
    rows = []
    for method, run in runs.items():
        for f in (run, against):  # compiled before, all that the choice may take
            f(*torus(40, "irregular"))
        own, beside = (functools.partial(f, vertices, faces) for f in (run, against))
        seconds, ratio = in_turn(own, beside, time.process_time, RUNS, SECONDS)
        micro = 1e6 * seconds / len(vertices)
        row = {"method": method, "vertices": len(vertices), "microseconds": micro}
        rows.append(row | {"ratio": ratio, "reference": reference})
    return pd.DataFrame(rows)


def _run(estimator, options):
    return lambda vertices, faces: estimate((vertices, faces), estimator, **options)


@kernel
def _searched(disk, rings: Literal[2] = 2):
    return (disk.count + 0.0,)


def phases(side: int) -> pd.DataFrame:
    """cost-phases.csv: what `compact_hermite` spends its time on, in microseconds a vertex.

    Parameters
    ----------
    side : int
        Of the irregular torus.

    Returns
    -------
    DataFrame
        Per `degree` and `phase` the `microseconds` (the least of three) and their `share`; the
        search of neighbours is a part of the two phases behind it.
    """
    vertices, faces = torus(side, "irregular")
    rows = []
    for degree in (6, 5, 4):
        found = [_phases(vertices, faces, degree) for _ in range(3)]
        least = {name: min(times[name] for times in found) for name in found[0]}
        total = sum(least.values()) - least["search"]
        rows += [
            {"degree": degree, "phase": name, "microseconds": 1e6 * x / len(vertices)}
            | {"share": x / total}
            for name, x in least.items()
        ]
    return pd.DataFrame(rows)


def _phases(vertices, faces, degree):
    mesh, times, clock = Mesh(vertices, faces), {}, time.process_time
    start = clock()
    mesh.find_adjacency()
    times["adjacency"] = clock() - start
    passes = Passes(mesh, 1)
    start = clock()
    passes.field(_searched)
    times["search"] = clock() - start
    start = clock()
    passes.field(normals)
    times["first normals"] = clock() - start
    start = clock()
    blocks, own = passes.equations(fitted, degree=degree)
    times["equations"] = clock() - start - times["first normals"]
    own = np.ascontiguousarray(own.T)
    start = clock()
    solve(blocks, own, 1)
    times["sweeps"] = clock() - start
    return times
