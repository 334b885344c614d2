"""Every claim decided from the published tables."""

import numpy as np
import pandas as pd

from curvlib.comparison.norms import VERTICES

from .cell import FAVOURITES, NINE, SEVEN, Cell, Holds, Orders
from .claim import Verdict
from .convergence import orders
from .sentences import CLAIMS

QUADRIC = "quadric"  # in place of a surface: the quadrics of the shrinking rings
TOGETHER = "all"  # in place of a surface: the SEVEN together
PAPER, REFINED = "paper", "refined"  # its resolutions and cut; more resolutions, other cuts
QUANTITIES = tuple(FAVOURITES)  # K and H
ORDERS = ["order", "order_low", "order_high", "verdict"]


def decide(readings, variants, curves, noise, rings) -> pd.DataFrame:
    """Decide every claim for every surface, cut and tabulated reading.

    Parameters
    ----------
    readings, variants, curves, noise, rings : DataFrame
        The tables of these names in `results/tables`, as `pandas.read_csv` reads them. `readings`
        maps a reading to variants; the others have a row per variant.

    Returns
    -------
    DataFrame
        `claims.csv`: claim, surface, diagonal, reading, `meshes` (`paper`: its resolutions and its
        cut; `refined`: up to the finest mesh, and other cuts), `holds` (true, false, undecided or
        degenerate), `from_n` (from which resolution on it holds), `from_24` (whether it does at
        every n >= 24, of which there is one), `effect` and `evidence`. A claim about an estimator
        that the reading does not have is undecided.
    """
    evidence = Evidence(variants, curves, noise, rings)
    by_reading = readings[readings.kind != "product"].groupby("reading", sort=False)
    rows = (row for _, reading in by_reading for row in evidence.rows(reading))
    return pd.DataFrame(rows, columns=COLUMNS).astype({"from_n": "Int64"})


COLUMNS = ["claim", "surface", "diagonal", "reading", "meshes", "holds", "from_n", "from_24"]
COLUMNS += ["effect", "evidence"]
FINE = 24  # "at fine meshes": from this n on


class Evidence:
    """Look-ups by variant, from which the cells of any reading are assembled."""

    def __init__(self, variants, curves=None, noise=None, rings=None):
        cut = ["surface", "diagonal"]
        self.cuts = list(variants[cut].drop_duplicates().itertuples(index=False, name=None))
        self.n = np.sort(variants.n.unique())
        shape = (len(self.cuts), len(self.n))
        self.paper, self.full, self.measured = np.zeros((3, *shape), dtype=bool)
        self.level = np.zeros((len(QUANTITIES), len(self.cuts)))
        # (counted, estimator, variant) -> means, vertices (quantities, cuts, resolutions)
        self.means, variant = {}, ["counted", "estimator", "variant"]
        self.missing = np.full((2, len(QUANTITIES), *shape), np.nan)
        row_of = {c: i for i, c in enumerate(self.cuts)}
        for key, rows in variants[variants.quantity.isin(QUANTITIES)].groupby(variant):
            place = [row_of[c] for c in zip(rows.surface, rows.diagonal)]
            n = np.searchsorted(self.n, rows.n)
            quantity = [QUANTITIES.index(q) for q in rows.quantity]
            self.means[key] = self.missing.copy()
            self.means[key][:, quantity, place, n] = rows["mean"], rows.vertices
            self.paper[place, n], self.full[place, n] = rows.paper, rows.full
            self.measured[place, n] = True
            self.level[quantity, place] = rows.rounding
        key = ["more", *cut, "counted", "quantity", "estimator", "variant"]
        self.curves = {} if curves is None else _look_up(curves, key)
        self.noise, self.rings, self.kinds = None, {}, []
        if noise is not None:
            trials = noise[noise.sigma > 0]
            key = ["surface", "n", "sigma", "quantity", "estimator", "variant"]
            self.noise = trials.set_index(key).response.to_dict()
            self.trials = list(trials[["n", "sigma"]].drop_duplicates().itertuples(index=False))
        if rings is not None:
            kinds = "valence-" + rings.valence.astype(str) + "-" + rings.ring
            key = ["kind", "quantity", "estimator", "variant"]
            self.rings = _look_up(rings.assign(kind=kinds), key)
            self.kinds = sorted(set(kinds))

    def rows(self, reading):
        """Yield rows of claims.csv for one reading, its rows of readings.csv."""
        name = reading.reading.iloc[0]
        variants = dict(zip(reading.estimator, reading.variant))
        cells = self.cells(reading)
        for meshes, cell in cells:
            first = (cell.surface, cell.diagonal, name, meshes)
            for claim in CLAIMS.values():
                if not claim.together:
                    yield from _row(claim, *first, cell.n, _verdict(claim, cell, variants))
        for meshes, diagonal in dict.fromkeys((meshes, cell.diagonal) for meshes, cell in cells):
            here = [c for m, c in cells if (m, c.diagonal) == (meshes, diagonal)]
            seven = [cell for cell in here if cell.surface in SEVEN]
            for claim in CLAIMS.values():
                if claim.together and seven:
                    verdict = _verdict(claim, seven, variants)
                    yield from _row(claim, TOGETHER, diagonal, name, meshes, here[0].n, verdict)
        if reading.counted.iloc[0] == VERTICES[0]:
            (claim,) = (claim for claim in CLAIMS.values() if claim.decide is orders)
            for kind in self.kinds:
                curve = _present(self.rings, (kind,), variants)
                cell = Cell(QUADRIC, kind, [0], {}, {}, {}, curve)
                verdict = _verdict(claim, cell, variants)._replace(from_n=np.nan)
                yield from _row(claim, QUADRIC, kind, name, REFINED, cell.n, verdict)

    def cells(self, reading) -> list[tuple]:
        """(meshes, Cell) for every surface and cut of one reading, its rows of readings.csv."""
        counted, more = reading[["counted", "more"]].iloc[0]
        variants = dict(zip(reading.estimator, reading.variant))
        keys = [(counted, name, variants.get(name)) for name in NINE]
        # (quantities, cuts, resolutions, 9)
        mean, vertices = np.stack([self.means.get(k, self.missing) for k in keys], axis=-1)
        most = np.fmax.reduce(vertices, axis=-1)
        # An estimator gains nothing by failing: a mean over fewer vertices is not compared.
        mean = np.where(vertices == most[..., None], mean, np.nan)
        found = []
        for i, (surface, diagonal) in enumerate(self.cuts):
            grids = {}
            if self.paper[i].any():
                grids[PAPER] = self.paper[i], False
            beyond = self.measured[i] if more else self.full[i]
            if (beyond & ~self.paper[i]).any():
                grids[REFINED] = beyond, more
            for meshes, (use, everywhere) in grids.items():
                place = (everywhere, surface, diagonal, counted)
                on_paper = self.noise is not None and meshes == PAPER
                cell = Cell(
                    surface,
                    diagonal,
                    self.n[use],
                    mean={q: mean[j, i, use] for j, q in enumerate(QUANTITIES)},
                    vertices={q: most[j, i, use] for j, q in enumerate(QUANTITIES)},
                    level={q: self.level[j, i] for j, q in enumerate(QUANTITIES)},
                    curve=_present(self.curves, place, variants),
                    response=self._response(surface, variants) if on_paper else {},
                )
                found.append((meshes, cell))
        return found

    def _response(self, surface, variants):
        """Quantity -> mean responses (trials, 9), NaN where there is none."""
        return {
            quantity: np.array(
                [
                    [
                        self.noise.get((surface, *trial, quantity, e, variants.get(e)), np.nan)
                        for e in NINE
                    ]
                    for trial in self.trials
                ]
            )
            for quantity in QUANTITIES
        }


def _look_up(curves, key):
    places = curves[key].itertuples(index=False, name=None)
    return dict(zip(places, map(Orders._make, curves[ORDERS].itertuples(index=False, name=None))))


def _present(curves, place, variants):
    """(quantity, estimator) -> Orders at a place, for a reading's variants."""
    keys = {(q, e): (*place, q, e, variants.get(e)) for q in QUANTITIES for e in NINE}
    return {short: curves[key] for short, key in keys.items() if key in curves}


def _verdict(claim, measured, variants):
    missing = [name for name in claim.about if name not in variants]
    if missing:
        words = "not in this study: " + ", ".join(missing)
        return Verdict(Holds.UNDECIDED, np.nan, words)
    return claim.decide(measured)


def _row(claim, surface, diagonal, reading, meshes, n, verdict):
    if verdict is not None:
        first = (claim.number, surface, diagonal, reading, meshes)
        fine = min((m for m in n if m >= FINE), default=-np.inf)
        last = (verdict.holds.value, verdict.from_n, bool(verdict.from_n <= fine))
        last += (verdict.effect, verdict.evidence)
        yield dict(zip(COLUMNS, first + last))
