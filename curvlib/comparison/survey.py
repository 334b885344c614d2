"""Every estimator on irregular meshes of surfaces in closed form: errors, orders, boundary."""

import numpy as np
import pandas as pd

from curvlib.estimation import estimate
from curvlib.meshes.jittered import SURFACES, jittered

from .calls import calls
from .quantities import QUANTITIES, compared, defined

RESOLUTIONS = (25, 50, 100)
SEEDS = (0, 1, 2)
KEY = ["estimator", "surface", "place", "quantity"]


def survey(names, threads: int = 1, resolutions=RESOLUTIONS, seeds=SEEDS) -> pd.DataFrame:
    """estimators.csv: mean errors of the `calls` of estimators on jittered meshes.

    Parameters
    ----------
    names : list of str
        Names or paths of estimators.
    threads : int
    resolutions : sequence of int
        n of meshes of n^2 vertices.
    seeds : sequence of int
        A mesh is made by each.

    Returns
    -------
    DataFrame
        Per `estimator` (the call), `surface`, `place` (`interior`, `boundary`), `quantity` that it
        returns and `n`: the mean error `value` over the vertices of all seeds' meshes; `defined`:
        the part of the vertices that have an estimate; `order`: log(e1 / e2) / log(n2 / n1) from
        the next coarser mesh.
    """
    every = calls(names)
    rows = []
    for surface in SURFACES:
        for n in resolutions:
            meshes = [jittered(surface, n, seed) for seed in seeds]
            for call in every:
                labels = {"estimator": str(call), "surface": surface, "n": n}
                rows += [labels | row for row in errors_on(meshes, call, threads)]
    table = with_orders(pd.DataFrame(rows), KEY)
    return table[[*KEY, "n", "value", "defined", "order"]]


def with_orders(table, key) -> pd.DataFrame:
    """A table sorted by key and `n`, with the `order` from the next coarser n of the same key."""
    table = table.sort_values([*key, "n"], ignore_index=True)
    before = table.groupby(key)[["value", "n"]].shift()
    with np.errstate(divide="ignore", invalid="ignore"):
        table["order"] = np.log(before.value / table.value) / np.log(table.n / before.n)
    return table


def errors_on(meshes, call, threads):
    """Yield rows of a Call on meshes of one resolution: place, quantity, value, defined."""
    errors = {}  # (place, quantity) -> of each mesh, NaN where undefined
    for mesh in meshes:
        found = estimate(mesh, call.estimator, threads, **call.options)
        for name, (exact, estimated) in compared(mesh, found).items():
            # The side of every surface is known, so that H has a sign.
            error = QUANTITIES[name].distance(exact, estimated)
            for place, part in (("interior", ~mesh.boundary), ("boundary", mesh.boundary)):
                if part.any():
                    errors.setdefault((place, name), []).append(error[part & defined(exact)])
    for (place, name), of_meshes in errors.items():
        values = np.concatenate(of_meshes)
        known = np.isfinite(values)
        mean = float(values[known].mean()) if known.any() else np.nan
        yield {"place": place, "quantity": name, "value": mean, "defined": known.mean()}
