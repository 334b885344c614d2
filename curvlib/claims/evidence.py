"""Every claim decided from the published tables."""

import numpy as np
import pandas as pd

from curvlib.comparison.norms import VERTICES

from .cell import FAVOURITES, NINE, SEVEN, Cell
from .sentences import CLAIMS, Verdict, orders

NOISE_SIGMA = 0.01
QUADRIC = "quadric"  # in place of a surface: the quadrics of the shrinking rings
BOTH = tuple(FAVOURITES)  # K and H
NORMS = ("mean", "q95", "max")
FIT = ["tail", "tail_stderr", "verdict"]


def decide(readings, variants, curves, noise, rings) -> pd.DataFrame:
    """Decide every claim for every surface, cut and reading.

    Parameters
    ----------
    readings, variants, curves, noise, rings : DataFrame
        The tables of these names in `results/tables`, as `pandas.read_csv` reads them. `readings`
        maps a reading to variants; the others have a row per variant.

    Returns
    -------
    DataFrame
        `claims.csv`: claim, surface, diagonal, reading, `holds` (true, false or undecided),
        `effect` and `evidence`. A claim about an estimator that the reading does not have is
        undecided.
    """
    evidence = _Evidence(variants, curves, noise, rings)
    by_reading = readings.groupby("reading", sort=False)
    return pd.DataFrame(row for _, reading in by_reading for row in evidence.decide(reading))


class _Evidence:
    """Look-ups by variant, from which the cells of any reading are assembled."""

    def __init__(self, variants, curves, noise, rings):
        full = variants[variants.full]
        cut = ["surface", "diagonal"]
        self.cuts = list(full[cut].drop_duplicates().itertuples(index=False, name=None))
        self.resolutions = np.sort(full.n.unique())
        # (counted, estimator, variant) -> errors (cuts, quantities, norms, resolutions)
        self.errors, variant = {}, ["counted", "estimator", "variant"]
        self.missing = np.full(
            (len(self.cuts), len(BOTH), len(NORMS), len(self.resolutions)), np.inf
        )
        self.levels = np.zeros((len(self.cuts), len(BOTH), 1, 1, 1))
        for key, rows in full[full.quantity.isin(BOTH)].groupby(variant):
            place = [self.cuts.index(c) for c in zip(rows.surface, rows.diagonal)]
            quantity = [BOTH.index(q) for q in rows.quantity]
            n = np.searchsorted(self.resolutions, rows.n)
            values = rows[list(NORMS)].fillna(np.inf)
            self.errors[key] = self.missing.copy()
            self.errors[key][place, quantity, :, n] = values
            self.levels[place, quantity, 0, 0, 0] = rows.rounding
        key = [*cut, "counted", "quantity", "estimator", "variant"]
        fitted = curves[["more", *key]].itertuples(index=False, name=None)
        self.curves = dict(zip(fitted, curves[FIT].itertuples(index=False, name=None)))
        noise = noise[noise.sigma == NOISE_SIGMA]
        noise = noise.set_index(["surface", "quantity", "estimator", "variant"]).value
        self.noise = dict(noise.dropna())
        kinds = "valence-" + rings.valence.astype(str) + "-" + rings.ring
        fitted = zip(kinds, rings.quantity, rings.estimator, rings.variant)
        fit = rings[["slope", "stderr", "verdict"]].itertuples(index=False, name=None)
        self.rings = dict(zip(fitted, fit))
        self.kinds = sorted(set(kinds))

    def decide(self, reading):
        """Yield rows of claims.csv for one reading, its rows of readings.csv."""
        counted, name, more = reading[["counted", "reading", "more"]].iloc[0]
        variants = dict(zip(reading.estimator, reading.variant))
        errors = [self.errors.get((counted, e, variants.get(e)), self.missing) for e in NINE]
        # Raised to the rounding level: (cuts, quantities, norms, resolutions, 9)
        errors = np.maximum(np.stack(errors, axis=-1), self.levels)
        cells = {
            (surface, diagonal): Cell(
                diagonal,
                self.resolutions,
                mean={q: of_cut[i, 0] for i, q in enumerate(BOTH)},
                finest={
                    (q, m): of_cut[i, j, -1]
                    for i, q in enumerate(BOTH)
                    for j, m in enumerate(NORMS)
                },
                noise={q: self._noise(surface, q, variants) for q in BOTH},
                curve=_present(self.curves, (more, surface, diagonal, counted), variants),
                consensus={},
            )
            for (surface, diagonal), of_cut in zip(self.cuts, errors)
        }
        for (surface, diagonal), cell in cells.items():
            peers = [cells[s, diagonal] for s in SEVEN if s != surface and (s, diagonal) in cells]
            for q in BOTH:
                ranks = [peer.ranks[q][-1] for peer in peers] or [np.full(len(NINE), np.nan)]
                cell.consensus[q] = np.mean(ranks, axis=0)
            for claim in CLAIMS.values():
                yield _row(claim, surface, diagonal, name, _verdict(claim, cell, variants))
        if counted == VERTICES[0]:
            (claim,) = (claim for claim in CLAIMS.values() if claim.decide is orders)
            for kind in self.kinds:
                curve = _present(self.rings, (kind,), variants)
                cell = Cell(kind, self.resolutions, {}, {}, {}, curve, {})
                yield _row(claim, QUADRIC, kind, name, _verdict(claim, cell, variants))

    def _noise(self, surface, quantity, variants):
        keys = [(surface, quantity, e, variants.get(e)) for e in NINE]
        return np.array([self.noise.get(key, np.inf) for key in keys])


def _present(curves, place, variants):
    """(quantity, estimator) -> the fit of its curve at a place, for a reading's variants."""
    keys = {(q, e): (*place, q, e, variants.get(e)) for q in BOTH for e in NINE}
    return {short: curves[key] for short, key in keys.items() if key in curves}


def _verdict(claim, cell, variants):
    missing = [name for name in claim.about if name not in variants]
    if missing:
        return Verdict(None, np.nan, "not in this study: " + ", ".join(missing))
    return claim.decide(cell)


def _row(claim, surface, diagonal, reading, decided):
    holds = {True: "true", False: "false", None: "undecided"}[decided.holds]
    first = {"claim": claim.number, "surface": surface, "diagonal": diagonal, "reading": reading}
    return first | {"holds": holds, "effect": decided.effect, "evidence": decided.evidence}
