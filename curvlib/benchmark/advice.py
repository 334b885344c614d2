"""Which estimator to use: for each situation the best in the benchmark, with cost and margin."""

from collections import namedtuple

import numpy as np
import pandas as pd

from curvlib.catalogue import peers

from .ranking import ranked

Situation = namedtuple("Situation", "name label words rows")
Situation.__doc__ = """A kind of mesh that users have: `words` says which meshes stand for it, and
`rows` picks theirs from errors.csv."""

IRREGULAR = ("decimated", "graded", "jittered", "random", "valence")
OPEN = (*IRREGULAR, "open")
LONG = ("anisotropic", "anisotropic_turned", "fan")
LITTLE, MUCH = 0.005, 0.04  # mean edges
DEFAULT = "adaptive_fit"
QUANTITIES = ("K", "H", "d1")
# A cheaper one is named where its error is at most so many times the best.
NEAR = 2.0


def _clean(errors, *names):
    inside = (errors.noise == "none") & (errors.place == "interior")
    return inside & errors.family.isin(names) if names else inside


def _noise(errors, low, high):
    level = errors.level
    kinds = ~errors.noise.isin(["none", "outliers"])
    return kinds & (level > low) & (level <= high) & (errors.place == "interior")


SITUATIONS = [
    Situation(
        "irregular",
        "Clean irregular meshes",
        "exact vertices: jittered, random, graded, decimated, of irregular valence",
        lambda e: _clean(e, *IRREGULAR),
    ),
    Situation(
        "grid",
        "Grids of parameters",
        "the NURBS surfaces of 2003, cut along lines of their parameters",
        lambda e: _clean(e, "grid"),
    ),
    Situation(
        "cad",
        "CAD tessellations",
        "long thin triangles and fans on a cylinder and a sphere, 1:10 triangles",
        lambda e: _clean(e, *LONG),
    ),
    Situation(
        "joints",
        "Sharp edges and joints",
        "a lens with a sharp rim, a cylinder that ends in half spheres; on the pieces",
        lambda e: _clean(e, "joints"),
    ),
    Situation(
        "marching_cubes",
        "Marching cubes",
        "linear interpolation of exact values at grid points",
        lambda e: _clean(e, "marching_cubes"),
    ),
    Situation(
        "voxels",
        "Voxels",
        "staircases: marching cubes over a mask",
        lambda e: _clean(e, "voxels"),
    ),
    Situation(
        "scans",
        "Range scans",
        "simulated: quantised depth, holes, one side",
        lambda e: _clean(e, "scan"),
    ),
    Situation(
        "boundary",
        "On a boundary",
        "the boundary vertices of clean open meshes",
        lambda e: (e.place == "boundary") & (e.noise == "none") & e.family.isin(OPEN),
    ),
    Situation(
        "little_noise",
        "Little noise",
        f"up to {LITTLE:g} mean edges, of all kinds but outliers",
        lambda e: _noise(e, 0, LITTLE),
    ),
    Situation(
        "noise",
        "Noise",
        f"from {LITTLE:g} to {MUCH:g} mean edges",
        lambda e: _noise(e, LITTLE, MUCH),
    ),
    Situation(
        "much_noise",
        "Much noise",
        f"above {MUCH:g} mean edges",
        lambda e: _noise(e, MUCH, np.inf),
    ),
    Situation(
        "outliers",
        "Outliers",
        "one vertex of 200 lies five mean edges off, the others have noise",
        lambda e: (e.noise == "outliers") & (e.place == "interior"),
    ),
]


def situations(errors: pd.DataFrame) -> pd.DataFrame:
    """situations.csv: the columns of `ranked` by `situation` and `quantity`."""
    found = []
    for situation in SITUATIONS:
        own = errors[situation.rows(errors)]
        if len(own):
            found.append(ranked(own.assign(situation=situation.name), ["situation", "quantity"]))
    return pd.concat(found, ignore_index=True)


def advice(table: pd.DataFrame, cost: pd.DataFrame) -> pd.DataFrame:
    """advice.csv: who is best, by how much, at what cost.

    Parameters
    ----------
    table : DataFrame
        From `situations`.
    cost : DataFrame
        cost.csv.

    Returns
    -------
    DataFrame
        Per `situation` and quantity (K, H, d1): the `best` of our estimators and the `second`;
        `margin`, the second's `over_best` over that of the best; `over_best` of the best itself,
        1 where it is the best on every mesh; `default_over`, that of `adaptive_fit` over this;
        `cheap`, the cheapest whose error is at most twice the best's; `microseconds` and `ratio` of
        cost for best, cheap and default; `rank_low`, `rank_high` of the best;
        `peer`: the best of other libraries, and `peer_over` its `over_best` over that of the best.
    """
    price, ratio = (cost.set_index("estimator")[name] for name in ("microseconds", "ratio"))
    rows, others = [], peers.names()
    for situation in SITUATIONS:
        for quantity in QUANTITIES:
            own = table[(table.situation == situation.name) & (table.quantity == quantity)]
            own = own[own["rank"].notna()]
            theirs = own[own.estimator.isin(others)].set_index("estimator").over_best
            own = own[own.estimator.isin(price.index) & ~own.estimator.isin(others)]
            if not len(own):
                continue
            own = own.sort_values(["over_best", "estimator"]).set_index("estimator")
            best = own.index[0]
            near = own.index[own.over_best <= NEAR * own.over_best.iloc[0]]
            cheap = min(near, key=lambda name: price[name])
            row = {"situation": situation.name, "quantity": quantity, "best": best}
            second = own.index[1] if len(own) > 1 else ""
            row |= {"over_best": own.over_best[best], "second": second, "cheap": cheap}
            row["margin"] = own.over_best[second] / own.over_best[best] if second else np.nan
            row["cheap_over"] = own.over_best[cheap] / own.over_best[best]
            default = own.over_best.get(DEFAULT, np.nan)
            row |= {"default_over": default / own.over_best[best], "of": len(own)}
            row |= {"rank_low": own.rank_low[best], "rank_high": own.rank_high[best]}
            if len(theirs):
                peer = theirs.idxmin()
                row |= {"peer": peer, "peer_over": theirs[peer] / own.over_best[best]}
            for who, name in (("best", best), ("cheap", cheap), ("default", DEFAULT)):
                row |= {f"{who}_microseconds": price.get(name), f"{who}_ratio": ratio.get(name)}
            rows.append(row)
    return pd.DataFrame(rows)
