"""Errors of estimators on the meshes of the benchmark, one tidy row per norm."""

import numpy as np

from curvlib.catalogue import families, peers
from curvlib.comparison.norms import largest_curvature
from curvlib.comparison.quantities import QUANTITIES, compared, defined
from curvlib.errors import InputError
from curvlib.estimation import estimate
from curvlib.meshes.noise import noisy

from .plan import NOISE

MESH = ("surface", "family", "noise", "level", "n")
COLUMNS = (*MESH, "vertices_of_mesh", "estimator", "place", "quantity", "norm")
COLUMNS += ("value", "scaled", "vertices", "undefined")
CAUSES = (*MESH, "vertices_of_mesh", "estimator", "cause", "vertices")
NORMS = ("mean", "median", "q95", "max")
# Scaled errors up to this are rounding.
ROUNDING = 1e-9
# Degrees of the largest angle between two directions.
RIGHT = 90.0


def meshes(plan, part: str):
    """Yield labels, MESH with their values, the mesh with exact values, and the one to estimate on.

    `part`: one of the plan's parts. Under noise the exact values are those of the points that the
    vertices had.
    """
    if not part.startswith(NOISE):
        module = families.module(part)
        for surface in module.SURFACES:
            for n in plan.resolutions(part):
                mesh = module.make(surface, n, plan.seed)
                yield dict(zip(MESH, (surface, part, "none", 0.0, n))), mesh, mesh
        return
    kind, noise = part.removeprefix(NOISE), plan.noise
    make = families.module(noise["family"]).make
    for surface in noise["surfaces"]:
        mesh = make(surface, noise["n"], plan.seed)
        for level in noise["levels"]:
            labels = dict(zip(MESH, (surface, noise["family"], kind, level, noise["n"])))
            yield labels, mesh, noisy(mesh, kind, level, plan.seed)


def measured(plan, part: str, threads: int = 1) -> tuple[list, list]:
    """Rows of COLUMNS and of CAUSES of all calls on the meshes of a part.

    A peer that is not installed has no rows; one that fails on a mesh has a cause that says so.
    """
    errors, causes, missing = [], [], set()
    for labels, exact, mesh in meshes(plan, part):
        for call in plan.calls():
            if call.estimator in missing:
                continue
            own = labels | {"vertices_of_mesh": len(mesh.vertices), "estimator": str(call)}
            try:
                found = estimate(mesh, call.estimator, threads, **call.options)
            except Exception as error:
                if call.estimator not in peers.names():
                    raise
                if isinstance(error, InputError):
                    missing.add(call.estimator)
                else:
                    cause = {"cause": f"failed: {type(error).__name__}"}
                    causes.append(own | cause | {"vertices": len(mesh.vertices)})
                continue
            errors += [own | row for row in error_rows(exact, found)]
            causes += [
                own | {"cause": cause, "vertices": count}
                for cause, count in found.undefined.items()
            ]
    return errors, causes


def error_rows(exact, found):
    """Yield place, quantity, norm, value, scaled, vertices and undefined of Estimates.

    Errors are |x - x_est|, of H and principal curvatures with their signs, and of directions the
    angle in degrees. `scaled` is free of the unit: of K over the square of the largest |k| of the
    exact mesh, of H, k1 and k2 over it, of an angle over 90 degrees. `place`: "interior", or
    "boundary" for vertices on one; `undefined`: vertices there with an exact value and no estimate.
    Norms over no vertex are left out.
    """
    largest = largest_curvature(exact)
    for name, (truth, estimated) in compared(exact, found).items():
        quantity, known = QUANTITIES[name], defined(truth)
        error = quantity.distance(truth, estimated)
        scale = largest**quantity.power if quantity.power else RIGHT
        for place, part in (("interior", ~exact.boundary), ("boundary", exact.boundary)):
            here = error[part & known]
            values = here[np.isfinite(here)]
            count = {"vertices": len(values), "undefined": len(here) - len(values)}
            if len(here) == 0:
                continue
            norms = dict.fromkeys(NORMS, np.nan)
            if len(values):
                middle, high = np.quantile(values, (0.5, 0.95))
                norms = dict(zip(NORMS, map(float, (values.mean(), middle, high, values.max()))))
            for norm, value in norms.items():
                row = {"place": place, "quantity": name, "norm": norm, "value": value}
                yield row | {"scaled": value / scale} | count


def orders(errors):
    """orders.csv: per surface, family, estimator, place and quantity the `order` of the mean error,
    the slope of log(value) over log(1 / sqrt(vertices of the mesh)), without noise.

    `errors`: DataFrame of COLUMNS. `points`: how many meshes; `order` is NaN for fewer than two.
    Errors within rounding, 1e-9 when scaled, are left out.
    """
    import pandas as pd

    key = ["surface", "family", "estimator", "place", "quantity"]
    clean = errors[(errors.noise == "none") & (errors.norm == "mean") & (errors.scaled > ROUNDING)]
    rows = []
    for labels, own in clean.groupby(key):
        x, y = np.log(own.vertices_of_mesh) / 2, -np.log(own.value)
        slope = np.polyfit(x, y, 1)[0] if own.vertices_of_mesh.nunique() > 1 else np.nan
        rows.append(dict(zip(key, labels)) | {"order": slope, "points": len(own)})
    return pd.DataFrame(rows, columns=[*key, "order", "points"])
