"""How often standard errors of `adaptive_fit` cover its errors, on meshes with exact values.

Constants of the estimator were set on the surfaces of `jittered`; those here are others.
"""

import numpy as np
import pandas as pd

from curvlib.estimation import estimate
from curvlib.meshes.noise import noisy

from .held_out import held_out
from .voxels import SPHERES, sphere

SURFACES = "blob", "pear", "ring", "wave", "bump"
QUANTITIES = "K", "H", "k1", "k2"
SEED = 1609
LEVELS = {
    "white": (1e-5, 1e-4, 1e-3, 1e-2, 0.05, 0.1, 0.2),
    "isotropic": (0.01, 0.05),
    "half": (0.01, 0.05),
    "correlated": (0.01, 0.05),
    "quantised": (0.01, 0.1),
}
"""Kinds of noise (`curvlib.meshes.noise`) and levels in mean edges."""


def table(resolutions=(25, 50, 100), seed=SEED, threads: int = 1) -> pd.DataFrame:
    """coverage.csv: errors of `adaptive_fit` over their standard errors.

    Parameters
    ----------
    resolutions : sequence of int
        Exact meshes have n^2 vertices for each n, those with noise for the second.
    seed : int
    threads : int

    Returns
    -------
    DataFrame
        Per `surface`, n, kind of `noise` (also "none" and "voxels"), `level` in mean edges, of
        voxels 1 / radius, and `quantity`: of the `vertices` that have values and are not on a
        boundary the part whose error is `within_1` and `within_2` standard errors; the median
        `ratio` of error and standard error; the medians of the `error`, of the `standard` error and
        of the `size` of the exact values. Exact values of a sphere of voxels are those of the
        sphere of the vertices' mean distance from the centre.
    """
    rows = []
    for k, surface in enumerate(SURFACES):
        for n in resolutions:
            mesh = held_out(surface, n, seed + k)
            rows += _rows(mesh, mesh, threads, surface=surface, n=n, noise="none", level=0.0)
        n = resolutions[min(1, len(resolutions) - 1)]
        mesh = held_out(surface, n, seed + k)
        for noise, levels in LEVELS.items():
            for level in levels:
                moved = noisy(mesh, noise, level, seed + k)
                labels = {"surface": surface, "n": n, "noise": noise, "level": level}
                rows += _rows(mesh, moved, threads, **labels)
    for name, r in SPHERES.items():
        if r <= max(resolutions):
            mesh = sphere(r)
            labels = {"surface": name, "n": 2 * r, "noise": "voxels", "level": 1 / r}
            rows += _rows(mesh, mesh, threads, **labels)
    return pd.DataFrame(rows)


def summary(table) -> pd.DataFrame:
    """coverage-summary.csv: of a `table`, by kind of noise and quantity the mean of `within_1` and
    `within_2` and the least and largest of the latter; the median of standard over median error and
    its largest; how many `cases` these are."""
    table = table.assign(over=table.standard / table.error)
    groups = table.groupby(["noise", "quantity"], sort=False)
    return groups.agg(
        within_1=("within_1", "mean"),
        within_2=("within_2", "mean"),
        least=("within_2", "min"),
        largest=("within_2", "max"),
        over=("over", "median"),
        most_over=("over", "max"),
        cases=("over", "size"),
    ).reset_index()


def _rows(exact, mesh, threads, **labels):
    found, inner = estimate(mesh, "adaptive_fit", threads), ~mesh.boundary
    if exact.K is None:
        k = 1 / np.linalg.norm(mesh.vertices, axis=1).mean()
        truth = {"K": k * k, "H": k, "k1": k, "k2": k}
    else:
        truth = {name: getattr(exact, name) for name in QUANTITIES}
    for quantity in QUANTITIES:
        values, true = np.broadcast_arrays(getattr(found, quantity), truth[quantity])
        standard = getattr(found, f"{quantity}_error")
        there = inner & np.isfinite(values)
        error, standard = np.abs(values - true)[there], standard[there]
        yield labels | {
            "quantity": quantity,
            "vertices": int(there.sum()),
            "within_1": (error <= standard).mean(),
            "within_2": (error <= 2 * standard).mean(),
            "ratio": np.median(error / standard),
            "error": np.median(error),
            "standard": np.median(standard),
            "size": np.median(np.abs(true[there])),
        }
