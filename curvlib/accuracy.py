"""How far estimates are from the exact values: error norms, convergence, ranks; tidy tables."""

import numpy as np
import pandas as pd

CURVE = ["surface", "diagonal", "estimator", "reading", "quantity"]

# Errors below this fraction of the surface's curvature (largest k^2 for K, k for H) are rounding.
ROUNDING = 1e-9

# |slope| below this, nearer to no order of convergence than to the first, is stagnation.
STAGNATION = 0.5


def tables(meshes, estimates, variants) -> dict:
    """The tables errors, convergence and ranks, by name.

    `meshes`: Mapping of mesh keys (surface, diagonal, n) to Mesh. `estimates`: for every
    estimator its Estimates by (mesh key, variant). `variants`: for every estimator the
    variant's key by reading.
    """
    rows, rounding = [], {}
    for key, mesh in meshes.items():
        labels = dict(zip(("surface", "diagonal", "n"), key))
        labels["triangles"] = len(mesh.faces)
        for quantity in ("K", "H"):
            level = rounding.get((key[0], quantity), 0)
            rounding[key[0], quantity] = max(level, rounding_level(mesh, quantity))
        for estimator, by_reading in variants.items():
            for reading, variant in by_reading.items():
                names = {"estimator": estimator, "reading": reading}
                rows += error_rows(mesh, estimates[estimator][key, variant], **labels, **names)
    errors = pd.DataFrame(rows)
    return {
        "errors": errors,
        "convergence": convergence(errors, rounding),
        "ranks": ranks(errors, rounding),
    }


def error_rows(exact, estimates, **labels):
    """Rows of errors.csv for one mesh and one estimate, as dicts.

    The error of K is |K - K_est|, that of H | |H| - |H_est| | as in the paper, blind to sign;
    the norm `mean-signed` is the mean of |H - H_est|. Counted are the vertices where exact
    value and estimate are both defined, `undefined` are the others.
    """
    for quantity in ("K", "H"):
        a, b = getattr(exact, quantity), getattr(estimates, quantity)
        defined = np.isfinite(a) & np.isfinite(b)
        if not np.isfinite(b).any():
            continue
        a, b = a[defined], b[defined]
        signed = np.abs(a - b)
        error = signed if quantity == "K" else np.abs(np.abs(a) - np.abs(b))
        count = {"vertices": int(defined.sum()), "undefined": int((~defined).sum())}
        norms = {
            "mean": error.mean(),
            "q95": np.quantile(error, 0.95),
            "max": error.max(),
            "mean-signed": signed.mean(),
        }
        for norm, value in norms.items():
            yield {**labels, "quantity": quantity, "norm": norm, "value": value, **count}


def rounding_level(exact, quantity):
    """The error of `quantity` below which nothing but rounding is left, for one mesh."""
    k = np.nanmax(np.abs([exact.k1, exact.k2]))
    return ROUNDING * (k * k if quantity == "K" else k)


def convergence(errors, rounding):
    """Rows of convergence.csv: the slope of log(mean error) over log(n) and what it says.

    `rounding`: rounding levels by (surface, quantity), a column of the table; errors below it
    are no part of the fit. Verdicts: `exact` where nothing exceeds rounding, else by the slope,
    which is -2 for an error of O(h^2): `converges` below -STAGNATION, `diverges` above it,
    `stagnates` between. Curves of one resolution are left out.
    """
    rows = []
    mean = errors[errors.norm == "mean"]
    for curve, points in mean.groupby(CURVE, sort=False):
        points = points.sort_values("n")
        if len(points) < 2:
            continue
        labels = dict(zip(CURVE, curve))
        level = rounding[labels["surface"], labels["quantity"]]
        above = points[points.value > level]
        slope, stderr, verdict = np.nan, np.nan, "exact"
        if len(above) > 1:
            slope, stderr = _fit(np.log(above.n.to_numpy()), np.log(above.value.to_numpy()))
            verdict = "stagnates"
            if abs(slope) >= STAGNATION:
                verdict = "converges" if slope < 0 else "diverges"
        monotone = bool((np.diff(points.value) < 0).all())
        result = {"slope": slope, "stderr": stderr, "monotone": monotone, "verdict": verdict}
        rows.append(labels | result | {"rounding": level})
    return pd.DataFrame(rows)


def ranks(errors, rounding):
    """Rows of ranks.csv: 1 for the smallest mean error; what differs by rounding shares a rank."""
    mean = errors[errors.norm == "mean"]
    groups = ["surface", "diagonal", "n", "reading", "quantity"]
    rows = []
    for key, group in mean.groupby(groups, sort=False):
        labels = dict(zip(groups, key))
        level = rounding[labels["surface"], labels["quantity"]]
        rank, last = 0, -np.inf
        ordered = group.sort_values(["value", "estimator"])
        for position, (name, value) in enumerate(zip(ordered.estimator, ordered.value)):
            if value > last + max(level, ROUNDING * abs(last)) or position == 0:
                rank, last = position + 1, value
            rows.append(labels | {"estimator": name, "value": value, "rank": rank})
    return pd.DataFrame(rows)


FAVOURITES = {"K": "gauss_bonnet", "H": "paraboloid"}


def answer(errors, convergence, ranks) -> str:
    """Markdown: where the paper's favourites are best, in the default reading at the finest n.

    A sentence per quantity, then a row per surface with the best estimator and its mean
    absolute error, and the favourite's rank.
    """
    finest = ranks[(ranks.n == errors.n.max()) & (ranks.reading == "default")]
    finest = finest[finest.diagonal == finest.diagonal.iloc[0]]
    rows, sentences = {s: {"surface": s} for s in finest.surface.unique()}, []
    for quantity, favourite in FAVOURITES.items():
        places = []
        for surface, row in rows.items():
            here = finest[(finest.surface == surface) & (finest.quantity == quantity)]
            best = here[here["rank"] == 1]
            names = ", ".join(sorted(best.estimator))
            curve = (convergence.surface == surface) & (convergence.quantity == quantity)
            exact = best.value.max() <= convergence.rounding[curve].max()
            error = "exact" if exact else f"{best.value.max():.2g}"
            row[f"best for {quantity} (mean error)"] = f"{names} ({error})"
            rank = here["rank"][here.estimator == favourite]
            if len(rank):
                row[f"rank of {favourite} for {quantity}"] = rank.iloc[0]
                places.append(rank.iloc[0])
        first = sum(place == 1 for place in places)
        sentences.append(
            f"For {quantity}, `{favourite}` is best, alone or tied, on {first} of {len(places)} "
            "surfaces."
        )
    table = pd.DataFrame(rows.values()).to_markdown(index=False, disable_numparse=True)
    return "  \n".join(sentences) + f"\n\n{table}\n"


def _fit(x, y):
    """Slope of the least-squares line and its standard error (NaN for two points)."""
    dx = x - x.mean()
    slope = (dx * y).sum() / (dx * dx).sum()
    rest = y - y.mean() - slope * dx
    freedom = len(x) - 2
    variance = (rest * rest).sum() / freedom if freedom else np.nan
    return slope, np.sqrt(variance / (dx * dx).sum())
