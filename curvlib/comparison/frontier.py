"""How far estimators past 2003 get on exact vertices: errors and orders beside other libraries.

On surfaces on which constants of estimators were set, and on others, which are held out.
"""

import numpy as np
import pandas as pd

from curvlib.catalogue import estimators, peers
from curvlib.errors import InputError
from curvlib.estimation import estimate
from curvlib.estimators import adaptive_fit, ball_regression, compact_hermite, jet
from curvlib.meshes import coupling
from curvlib.meshes.jittered import JITTER, jittered
from curvlib.meshes.jittered import SURFACES as SEEN
from curvlib.meshes.torus import torus

from . import hessians
from .calls import Call, calls
from .held_out import KINDS, STRETCH, held_out
from .references import principal_axes
from .survey import errors_on, with_orders

SEED = 711  # used for nothing else
# The jet of CGAL over three rings, by which errors are divided.
REFERENCE = "principal_axes(degree=4, rings=3)"
NEW = (
    Call("adaptive_fit", {}),
    Call("compact_hermite", {}),
    Call("compact_hermite", {"degree": 5}),
    Call("compact_hermite", {"degree": 4}),
    Call("jet", {"degree": 6, "rings": 3}),
    Call("jet", {"degree": 4}),
)
# Further options of peers.
PEERS = {"cgal_jet": [{"degree": 4, "rings": 3}], "libigl_principal": [{"rings": 2}]}
KEY = ["surface", "kind", "estimator", "place", "quantity"]


class Reference(Call):
    """The jet of CGAL as a Call."""

    __slots__ = ()

    def __str__(self):
        return REFERENCE


def accuracy(resolutions, threads: int = 1) -> pd.DataFrame:
    """accuracy.csv: mean errors of estimators and peers.

    Parameters
    ----------
    resolutions : sequence of int
        n of meshes of about n^2 vertices. The calls of NEW and REFERENCE are run on all; those of
        all other estimators and of the peers that are installed on the jittered meshes of the two
        coarsest that are held out.
    threads : int

    Returns
    -------
    DataFrame
        Per `surface`, `kind` of points, `n`, `estimator` (the call), `place` (`interior`,
        `boundary`) and quantity that it returns: `held_out`; `closed`; mean error `value` inside;
        the part of the vertices `defined`; `ratio` of the value to that of REFERENCE; `order` from
        the next coarser mesh.
    """
    rows = []
    first = [Reference(principal_axes, {"degree": 4, "rings": 3}), *NEW]
    known = {str(call) for call in first}
    others = [c for c in calls(estimators.names()) if str(c) not in known]
    there = [row.method for row in installed().itertuples() if row.installed]
    others += [Call(name, options) for name in there for options in ({}, *PEERS.get(name, ()))]
    for surface, kind, held in every_mesh():
        for n in sorted(resolutions):
            mesh = _mesh(surface, kind, n)
            labels = {"surface": surface, "kind": kind, "held_out": held, "n": n}
            labels["closed"] = not mesh.boundary.any()
            more = others if held and kind == "jittered" and n in sorted(resolutions)[:2] else ()
            for call in (*first, *more):
                row = labels | {"estimator": str(call)}
                rows += [row | found for found in errors_on([mesh], call, threads)]
    table = with_orders(pd.DataFrame(rows), KEY)
    same = ["surface", "kind", "n", "place", "quantity"]
    theirs = table[table.estimator == REFERENCE].set_index(same).value
    table["ratio"] = table.value / theirs.reindex(pd.MultiIndex.from_frame(table[same])).to_numpy()
    return table


def on(surfaces, resolutions) -> dict:
    """(surface, kind, n) -> Mesh, of pairs of surface and kind at each n."""
    return {(*pair, n): _mesh(*pair, n) for pair in surfaces for n in resolutions}


def _mesh(surface, kind, n):
    return jittered(surface, n, SEED) if surface in SEEN else held_out(surface, n, SEED, kind)


def every_mesh():
    """(surface, kind of points, whether it is held out) of all families of meshes."""
    yield from ((surface, "jittered", False) for surface in SEEN)
    yield from ((surface, kind, True) for surface, kinds in KINDS.items() for kind in kinds)


def installed() -> pd.DataFrame:
    """peers.csv: per `method` of another library its `label`, whether it is `installed`, and what
    is missing."""
    rows = []
    for name in peers.names():
        try:
            estimate(torus(8, "regular"), name)
            missing = ""
        except InputError as error:
            missing = str(error)
        module = peers.module(name)
        row = {"method": name, "label": module.LABEL, "installed": not missing}
        rows.append(row | {"missing": missing})
    return pd.DataFrame(rows)


def summary(table) -> pd.DataFrame:
    """targets.csv: a table of `accuracy` by group of meshes.

    Returns
    -------
    DataFrame
        Per `estimator`, `group` (closed or open, kind of points), `n` and quantity (K, H), inside:
        of the ratios to REFERENCE on its `meshes` the geometric `mean`, the `best` and the `worst`;
        the least `order` from the next coarser mesh.
    """
    inside = table[(table.place == "interior") & table.quantity.isin(["K", "H"])]
    shape = inside.closed.map({True: "closed ", False: "open "})
    inside = inside.assign(group=shape + inside.kind, logarithm=np.log(inside.ratio))
    groups = inside.groupby(["estimator", "group", "n", "quantity"])
    found = groups.agg(
        mean=("logarithm", "mean"),
        best=("ratio", "min"),
        worst=("ratio", "max"),
        order=("order", "min"),
        meshes=("ratio", "size"),
    )
    return found.assign(mean=np.exp(found["mean"])).reset_index()


def constants() -> dict:
    """The constants of the fits that the article names."""
    return {
        "slope": compact_hermite.SLOPE,
        "gain": compact_hermite.GAIN,
        "sine": jet.SINE,
        "inner": ball_regression.INNER,
        "sample": adaptive_fit.SAMPLE,
        "near": adaptive_fit.NEAR,
        "tolerance": coupling.TOLERANCE,
        "sweeps": coupling.SWEEPS,
        "jitter": JITTER,
        "stretch": STRETCH,
        "second": hessians.SECOND,
        "second_slope": hessians.SLOPE,
    }
