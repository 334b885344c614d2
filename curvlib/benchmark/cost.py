"""What each estimator of the benchmark costs: processor time, in pairs with a reference."""

import functools
import time

from curvlib.catalogue import peers
from curvlib.comparison.turns import in_turn
from curvlib.errors import InputError
from curvlib.estimation import estimate
from curvlib.meshes.torus import torus

REFERENCE = "gauss_bonnet"
RUNS, SECONDS = 5, 2.0  # a method is run until one of these is reached


def cost(plan):
    """cost.csv: `microseconds` of processor time a vertex, on one thread, from arrays to values.

    `ratio`: to `gauss_bonnet`, the median of the ratios of runs in turn. The mesh is an irregular
    torus of `plan.cost`^2 vertices. Peers that are not installed, or fail, are left out.
    """
    import pandas as pd

    mesh, rows = torus(plan.cost, "irregular"), []
    reference, count = functools.partial(estimate, mesh, REFERENCE), len(mesh[0])
    for call in plan.calls():
        run = functools.partial(estimate, mesh, call.estimator, **call.options)
        try:
            estimate(torus(16, "irregular"), call.estimator, **call.options)
            run()
        except Exception as error:
            if call.estimator in peers.names() and not isinstance(error, MemoryError):
                continue
            raise InputError(f"{call}: {error}") from error
        seconds, ratio = in_turn(run, reference, time.process_time, RUNS, SECONDS)
        row = {"estimator": str(call), "vertices": count, "microseconds": 1e6 * seconds / count}
        rows.append(row | {"ratio": ratio})
    return pd.DataFrame(rows)
