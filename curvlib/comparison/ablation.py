"""What each part of the fits is worth: the same fits without it, or with another value."""

from typing import Literal

import numpy as np
import pandas as pd

from curvlib.estimation import estimate
from curvlib.estimators.compact_hermite import GAIN, SINE, SLOPE
from curvlib.estimators.compact_hermite import normals as normals
from curvlib.estimators.jet import WIDEST, fit_jet, weigh
from curvlib.kit.compiled import kernel
from curvlib.kit.coupled import Coupled
from curvlib.kit.hermite import fit_hermite
from curvlib.kit.polynomial import fit_polynomial
from curvlib.kit.tensor import from_graph
from curvlib.kit.vectors import tangents
from curvlib.kit.wider import wider

from .contraction import radius, sweeps, system

# What `jet` has; and what is changed of it, one at a time.
DEFAULT = {"centre": "through", "weights": "ring", "frame": "facets", "sine": 3e-3}
CHANGES = (
    {},
    {"centre": "free"},
    {"weights": "none"},
    {"centre": "free", "weights": "none"},
    {"frame": "refitted"},
    {"sine": 3e-2},
    {"sine": 3e-4},
    {"sine": 3e-5},
)
SLOPES, GAINS = (0.003, 0.01, 0.03, 0.1, 0.3, 1.0), (0.2, 0.7, 2.0, 1e9)
SWEEPS = (0, 1, 2, 3, 4, 6, 8, 12, 16)


@kernel
def polynomial(
    disk,
    degree: Literal[6, 5, 4, 3] = 6,
    rings: Literal[3, 2, 4, 5] = 3,
    centre: Literal["through", "free"] = "through",
    weights: Literal["ring", "none"] = "ring",
    frame: Literal["facets", "refitted"] = "facets",
    sine: Literal[3e-3, 3e-2, 3e-4, 3e-5] = 3e-3,
):
    """`jet` with its parts apart: through the vertex or not; weighted by ring or not; in the frame
    of the normal of the triangles, or of that of a first fit; with other limits of the guard."""
    N = disk.normal
    X, Y = tangents(N)
    for again in range(1 + (frame == "refitted")):
        while True:
            if weights == "ring":
                weigh(disk, rings)
            f, reached = fit_polynomial(
                disk, X, Y, N, 1 if centre == "through" else 0, degree, sine
            )
            narrow = disk.count
            if reached == degree or disk.walk.rings >= WIDEST:
                break
            disk, _ = wider(disk)
            if disk.count == narrow:
                break
        if again == 0 and frame == "refitted" and f[0] == f[0]:
            N = from_graph(*f, X, Y, N)[1]
            X, Y = tangents(N)
    return from_graph(*f, X, Y, N)[0]


@kernel
def hermite(
    disk,
    normals,
    degree: Literal[6, 5, 4] = 6,
    slope: Literal[SLOPES] = SLOPE,
    gain: Literal[GAINS] = GAIN,
) -> Coupled:
    """The equations of `compact_hermite` with another weight of slopes or limit of the gain; where
    they are turned away, a vertex takes the same jet."""
    N = normals[0, 0], normals[1, 0], normals[2, 0]
    X, Y = tangents(N)
    if degree > 4:
        disk, normals = wider(disk)
    for more in range(2):
        if more:
            disk, normals = wider(disk)
        inside = True
        for i in range(1 + disk.count):
            inside = inside and normals[3, i] == 1
        if not inside:
            break
        f, found, derivatives = fit_hermite(disk, normals, X, Y, N, degree, slope, SINE)
        if found <= gain:
            return Coupled((f[0], f[1]), (f[2], f[3], f[4]), N, derivatives, disk.count)
    f, _, _ = fit_jet(disk, X, Y, N, degree, 2 if degree == 4 else 3, True)
    return Coupled((f[0], f[1]), (f[2], f[3], f[4]), N, disk.rows, 0)


def jets(meshes, threads: int = 1) -> pd.DataFrame:
    """ablation-jets.csv: mean errors of jets of degree 3 to 6 over 2 to 5 rings, and of those of
    degrees 4 and 6 over the fewest rings with one part changed.

    Parameters
    ----------
    meshes : dict
        (surface, kind, n) -> Mesh with exact K and H.
    threads : int

    Returns
    -------
    DataFrame
        Per mesh, `degree`, `rings`, `change` (what differs from `jet`, `none` for itself), `place`
        and quantity the mean `value`, and the `worst`.
    """
    calls = [(d, k, {}) for d in (3, 4, 5, 6) for k in (2, 3, 4, 5)]
    calls += [(d, k, c) for d, k in ((4, 2), (6, 3)) for c in CHANGES[1:]]
    rows = []
    for key, mesh in meshes.items():
        for degree, rings, change in calls:
            found = estimate(mesh, polynomial, threads, degree=degree, rings=rings, **change)
            labels = dict(zip(("surface", "kind", "n"), key)) | {"degree": degree, "rings": rings}
            labels["change"] = ", ".join(f"{k}={v}" for k, v in change.items()) or "none"
            rows += [labels | row for row in _errors(mesh, found.K, found.H)]
    return pd.DataFrame(rows)


def compact(meshes, threads: int = 1) -> pd.DataFrame:
    """ablation-compact.csv: the compact scheme with other weights of slopes, limits of the gain and
    numbers of sweeps; `change` says which.

    Returns
    -------
    DataFrame
        Per mesh, `degree`, `change`, its `setting` and quantity the mean error `value` inside, and
        the spectral `radius` of a sweep.
    """
    rows = []
    for key, mesh in meshes.items():
        for degree in (6, 4):
            settings = [("slope", x) for x in SLOPES] + [("gain", x) for x in GAINS]
            for change, setting in settings:
                options = {"degree": degree, change: setting}
                found = sweeps(mesh, (200,), threads, function=hermite, **options)
                M, _, _ = system(mesh, hermite, threads, **options)
                rows += _labelled(key, degree, change, setting, found, radius(M))
            for count, found in sweeps(mesh, SWEEPS, threads, degree=degree).groupby("sweeps"):
                rows += _labelled(key, degree, "sweeps", count, found, np.nan)
    return pd.DataFrame(rows)


def _labelled(key, degree, change, setting, found, rate):
    labels = dict(zip(("surface", "kind", "n"), key)) | {"degree": degree, "change": change}
    labels |= {"setting": setting, "radius": rate}
    return [labels | {"quantity": row.quantity, "value": row.value} for row in found.itertuples()]


def _errors(mesh, K, H):
    for place, part in (("interior", ~mesh.boundary), ("boundary", mesh.boundary)):
        if part.any():
            for name, found, exact in (("K", K, mesh.K), ("H", H, mesh.H)):
                error = np.abs(found - exact)[part]
                row = {"place": place, "quantity": name, "value": np.nanmean(error)}
                yield row | {"worst": np.nanmax(error)}
