"""Two experiments beyond the paper: noise on its meshes, and one-rings that shrink on quadrics."""

import numpy as np

from curvlib.catalogue import estimators
from curvlib.estimation import estimate, takes_mesh
from curvlib.kit.ring import one_ring

from .quantities import QUANTITIES, absolute

# Standard deviation of the displacement, as a fraction of the mean edge.
SIGMAS = (0.0, 0.001, 0.01, 0.05)
NOISE_DRAWS = 10

VALENCES = range(3, 10)
SIZES = 0.5 ** np.arange(1, 9)
RING_DRAWS = 100

NOISE_COLUMNS = ("variant", "quantity", "sigma", "draws", "value", "spread")
RING_COLUMNS = ("variant", "valence", "ring", "h", "quantity", "value", "undefined")


def noise_rows(mesh, estimator: str, variants: dict, seed: int = 0):
    """Yield dicts of NOISE_COLUMNS for one Mesh: mean errors under displaced vertices.

    Every vertex moves along its exact normal by a normal deviate, the same for all estimators.
    The moved mesh keeps the normals of the clean surface: the reading `normal=exact` is an oracle
    here. Mean errors are over the vertices that are defined in all draws; `value` is their mean
    over the draws, `spread` their standard deviation; NaN without such a vertex.
    """
    edges = mesh.vertices[mesh.faces] - mesh.vertices[np.roll(mesh.faces, -1, axis=1)]
    length = np.linalg.norm(edges, axis=2).mean()
    for sigma in SIGMAS:
        rng = np.random.default_rng(seed)
        draws = NOISE_DRAWS if sigma else 1
        shifts = sigma * length * rng.standard_normal((draws, len(mesh.vertices), 1))
        # Where the normal is undefined the vertex stays.
        noisy = [mesh.moved(mesh.vertices + np.nan_to_num(s * mesh.normals)) for s in shifts]
        for variant, options in variants.items():
            results = [estimate(m, estimator, **options) for m in noisy]
            for name, quantity in QUANTITIES.items():
                estimates = np.array([getattr(result, name) for result in results])
                exact = getattr(mesh, name)
                defined = np.isfinite(estimates).all(0) & np.isfinite(exact)
                means = np.full(draws, np.nan)
                if defined.any():
                    means = quantity.error(exact, estimates)[:, defined].mean(1)
                yield {
                    "variant": variant,
                    "quantity": name,
                    "sigma": sigma,
                    "draws": draws,
                    "value": float(means.mean()),
                    "spread": float(means.std()),
                }


def ring_rows(estimator: str, variants: dict, seed: int = 0):
    """Yield dicts of RING_COLUMNS: mean absolute error against ring size h, valence by valence.

    Each draw is a quadric through the origin, tangent to z = 0 there,

        z = (k1 x^2 + k2 y^2) / 2 + z (p x + q y) + r z^2 / 2,

    and a ring about the origin: `regular` neighbours at equal angles and distances h in the
    tangent plane, `irregular` ones jittered in both. Errors are of signed values, since the side
    of a ring is known. `undefined` counts the draws without one. An estimator that is given the
    mesh has no rows.
    """
    function = estimators.module(estimator).estimate
    if takes_mesh(function):
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
            exact = {"K": (k1 * k2)[0], "H": -(k1 + k2)[0] / 2}
            exact |= {"k1": -np.minimum(k1, k2)[0], "k2": -np.maximum(k1, k2)[0]}
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
                    by_name = dict(zip(getattr(returned, "_fields", ("K", "H")), returned))
                    for quantity in QUANTITIES:
                        if by_name.get(quantity) is None:
                            continue
                        error = absolute(exact[quantity], by_name[quantity])
                        defined = np.isfinite(error)
                        yield {
                            "variant": variant,
                            "valence": n,
                            "ring": kind,
                            "h": float(h),
                            "quantity": quantity,
                            "value": float(error[defined].mean()) if defined.any() else np.nan,
                            "undefined": int((~defined).sum()),
                        }
