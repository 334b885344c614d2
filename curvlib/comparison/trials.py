"""Two experiments beyond the paper: noise on its meshes, and one-rings that shrink on quadrics."""

import functools
import zlib
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from curvlib.catalogue import estimators
from curvlib.estimation import estimate
from curvlib.kit.ring import one_ring
from curvlib.signatures import Signature

from .norms import edge_lengths
from .quantities import QUANTITIES, compared, defined
from .run import write_rows

# Standard deviation of the displacement, as a fraction of the mean edge.
SIGMAS = (0.0, 0.001, 0.01, 0.05)
NOISE_DRAWS = 10

VALENCES = range(3, 10)
SIZES = 0.5 ** np.arange(1, 9)
RING_DRAWS = 100

NOISE_COLUMNS = ("surface", "n", "variant", "quantity", "sigma", "draws", "value", "spread")
NOISE_COLUMNS += ("response", "response_spread", "vertices")
RING_COLUMNS = ("variant", "valence", "ring", "h", "quantity", "value", "undefined")


def noise_table(path, runs, meshes) -> None:
    """Write `noise_rows` of runs, pairs of an estimator (name or path) and its variants, on meshes,
    MeshKey -> Mesh."""
    rows = (
        {"estimator": Path(estimator).stem} | row
        for estimator, variants in runs
        for key, mesh in meshes.items()
        for row in noise_rows(key, mesh, estimator, variants)
    )
    write_rows(path, ("estimator", *NOISE_COLUMNS), rows)


def ring_table(path, runs) -> None:
    """Write `ring_rows` of runs, as in `noise_table`."""
    rows = (
        {"estimator": Path(estimator).stem} | row
        for estimator, variants in runs
        for row in ring_rows(estimator, variants)
    )
    write_rows(path, ("estimator", *RING_COLUMNS), rows)


def noise_rows(key, mesh, estimator: str, variants: dict):
    """Yield dicts of NOISE_COLUMNS for the Mesh of a MeshKey: mean errors under displaced vertices.

    Every vertex moves along its exact normal by sigma mean edges times a normal deviate; where the
    normal is undefined the vertex stays. The draws depend on surface and n alone. The moved mesh
    has no exact normals, so that a variant with `normal=exact` cannot run on it and has no rows.

    Means are over the interior `vertices` that have an exact value and an estimate on the clean
    mesh and in all draws; without such a vertex they are NaN. `value` is the mean error, `response`
    the mean of |x_noisy - x_clean|, x the estimate (of directions the angle): what noise does to
    it, whatever its error. `spread` and `response_spread` are the standard deviations of either
    over the draws.
    """
    length = edge_lengths(mesh).mean()
    rng = np.random.default_rng([zlib.crc32(key.surface.encode()), key.n])
    deviates = rng.standard_normal((NOISE_DRAWS, len(mesh.vertices), 1))
    steps = np.nan_to_num(length * deviates * mesh.normals)
    still = [mesh.moved(mesh.vertices)]
    moved = {s: [mesh.moved(mesh.vertices + s * step) for step in steps] for s in SIGMAS if s}
    for variant, options in variants.items():
        if options.get("normal") == "exact":
            continue
        clean = estimate(still[0], estimator, **options)
        for sigma in SIGMAS:
            results = [estimate(m, estimator, **options) for m in moved.get(sigma, still)]
            for name, (exact, before) in compared(mesh, clean).items():
                after = np.array([getattr(result, name) for result in results])
                everywhere = map(defined, (exact, before, *after))
                there = functools.reduce(np.logical_and, everywhere, ~mesh.boundary)
                exact, before, after = exact[there], before[there], after[:, there]
                quantity = QUANTITIES[name]
                row = {"surface": key.surface, "n": key.n, "variant": variant, "quantity": name}
                row |= {"sigma": sigma, "draws": len(results)}
                row |= _over_draws("value", "spread", quantity.error(exact, after))
                row |= _over_draws("response", "response_spread", quantity.distance(before, after))
                yield row | {"vertices": int(there.sum())}


def _over_draws(mean, spread, distances):
    """The mean of distances (draws, vertices), and the standard deviation of the draws' means."""
    means = distances.mean(1) if distances.size else np.full(1, np.nan)
    return {mean: float(means.mean()), spread: float(means.std())}


def ring_rows(estimator: str, variants: dict, seed: int = 0):
    """Yield dicts of RING_COLUMNS: mean absolute error against ring size h, valence by valence,
    of the quantities that are `compared`.

    Each draw is a quadric through the origin, tangent to z = 0 there,

        z = (k1 x^2 + k2 y^2) / 2 + z (p x + q y) + r z^2 / 2,

    and a ring about the origin: `regular` neighbours at equal angles and distances h in the
    tangent plane, `irregular` ones jittered in both. Errors are of signed values, since the side
    of a ring is known. `undefined` counts the draws without one. An estimator that is not given
    rings has no rows.
    """
    function = estimators.module(estimator).estimate
    if Signature.of(estimator, function).given != "ring":
        return
    for n in VALENCES:
        for kind, jitter in (("regular", 0.0), ("irregular", 0.2)):
            rng = np.random.default_rng([seed, n])
            k1, k2, p, q, r = rng.uniform(-1, 1, (5, 1, RING_DRAWS))
            p, q, r = p / 2, q / 2, r / 2  # so that the quadric reaches over the largest ring
            turn = rng.uniform(0, 2 * np.pi, (1, RING_DRAWS))
            steps = np.arange(n)[:, None] + jitter * rng.uniform(-1, 1, (n, RING_DRAWS))
            distance = 1 + jitter * rng.uniform(-1, 1, (n, RING_DRAWS))
            angle = turn + 2 * np.pi * steps / n
            # The normal is +z, from which the quadric bends away where k1 and k2 are negative.
            exact = SimpleNamespace(K=(k1 * k2)[0], H=-(k1 + k2)[0] / 2)
            exact.k1, exact.k2 = -np.minimum(k1, k2)[0], -np.maximum(k1, k2)[0]
            exact.d1 = np.where((k1 < k2).T, (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
            for h in SIZES:
                x, y = h * distance * np.cos(angle), h * distance * np.sin(angle)
                f, b = (k1 * x * x + k2 * y * y) / 2, 1 - p * x - q * y
                z = 2 * f / (b + np.sqrt(b * b - 2 * r * f))
                up = np.zeros((3, RING_DRAWS))
                up[2] = 1
                ring = one_ring(np.stack((x, y, z)), up)
                for variant, options in variants.items():
                    with np.errstate(divide="ignore", invalid="ignore"):
                        returned = function(ring, **options)
                    names = getattr(returned, "_fields", ("K", "H"))
                    values = zip(names, returned)
                    found = {name: np.transpose(x) for name, x in values if x is not None}
                    found = SimpleNamespace(returned=tuple(found), **found)
                    for quantity, both in compared(exact, found).items():
                        error = QUANTITIES[quantity].distance(*both)
                        known = np.isfinite(error)
                        yield {
                            "variant": variant,
                            "valence": n,
                            "ring": kind,
                            "h": float(h),
                            "quantity": quantity,
                            "value": float(error[known].mean()) if known.any() else np.nan,
                            "undefined": int((~known).sum()),
                        }
