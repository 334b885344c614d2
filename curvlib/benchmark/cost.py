"""What each estimator of the benchmark costs: processor time, in pairs with a reference."""

import statistics
import time

import numpy as np

from curvlib.catalogue import peers
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

    vertices, faces = torus(plan.cost, "irregular")
    rows = []
    for call in plan.calls():
        try:
            estimate(torus(16, "irregular"), call.estimator, **call.options)
            _seconds(call.estimator, call.options, vertices, faces)
        except Exception as error:
            if call.estimator in peers.names() and not isinstance(error, MemoryError):
                continue
            raise InputError(f"{call}: {error}") from error
        own, ratios, start = [], [], time.process_time()
        while not own or (len(own) < RUNS and time.process_time() - start < SECONDS):
            beside = _seconds(REFERENCE, {}, vertices, faces)
            own.append(_seconds(call.estimator, call.options, vertices, faces))
            ratios.append(own[-1] / beside)
        micro = 1e6 * statistics.median(own) / len(vertices)
        row = {"estimator": str(call), "vertices": len(vertices), "microseconds": micro}
        rows.append(row | {"ratio": float(np.median(ratios))})
    return pd.DataFrame(rows)


def _seconds(estimator, options, vertices, faces):
    start = time.process_time()
    estimate((vertices, faces), estimator, **options)
    return time.process_time() - start
