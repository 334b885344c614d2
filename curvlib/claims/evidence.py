"""The claims' evidence: a Cell for every surface, cut and reading, decided and summed up."""

import numpy as np
import pandas as pd

from curvlib.comparison.accuracy import convergence, rounding_levels, slope_fit, verdict
from curvlib.comparison.norms import VERTICES

from .sentences import CLAIMS, NINE, SEVEN, Cell, orders, ranks

NOISE_SIGMA = 0.01


class Evidence:
    """The tables as look-ups, from which any reading's cells are put together.

    `rows`: of `accuracy.by_variant`; `noise`: of `trials`; `rings`: of `ring_slopes`. Estimates
    are shared: a reading only names its variants.
    """

    def __init__(self, rows, noise, rings):
        self.levels = rounding_levels(rows)
        full = rows[rows.full]
        self.resolutions = np.sort(full.n.unique())
        self.places = list(full[["surface", "diagonal"]].drop_duplicates().itertuples(index=False))
        key = ["surface", "diagonal", "counted", "quantity", "norm", "estimator", "variant"]
        by_n = full.set_index([*key, "n"]).value.unstack("n")
        self.errors = dict(zip(by_n.index, by_n.fillna(np.inf).to_numpy()))
        fits = ["tail", "tail_stderr", "verdict"]
        place = ["surface", "diagonal", "counted"]
        # By whether a reading was run on more meshes than the full ones.
        self.curves = {
            more: _fits(convergence(r), place, fits) for more, r in ((True, rows), (False, full))
        }
        noise = noise[noise.sigma == NOISE_SIGMA]
        noise = noise.set_index(["surface", "quantity", "estimator", "variant"]).value
        self.noise = dict(noise)
        cuts = "valence-" + rings.valence.astype(str) + "-" + rings.ring
        rings = rings.assign(surface="quadric", diagonal=cuts)
        self.rings = _fits(rings, place[:2], ["slope", "stderr", "verdict"])
        self.ring_places = sorted({key[:2] for key in self.rings})

    def decide(self, reading: pd.DataFrame):
        """Yield rows of claims.csv for one reading, its rows of readings.csv."""
        counted, name, more = reading[["counted", "reading", "more"]].iloc[0]
        variants = dict(zip(reading.estimator, reading.variant))
        errors = {place: self._errors(*place, counted, variants) for place in self.places}
        for (surface, diagonal), found in errors.items():
            peers = [errors[s, diagonal] for s in SEVEN if s != surface and (s, diagonal) in errors]
            places = {q: [ranks(peer[q, "mean"][-1]) for peer in peers] for q in "KH"}
            alone = np.full(len(NINE), np.nan)
            consensus = {q: np.mean(p, axis=0) if p else alone for q, p in places.items()}
            noise = {q: self._noise(surface, q, variants) for q in "KH"}
            cell = Cell(
                diagonal,
                self.resolutions,
                mean={q: found[q, "mean"] for q in "KH"},
                finest={key: values[-1] for key, values in found.items()},
                noise=noise,
                curve=self._curves((surface, diagonal, counted), variants, self.curves[more]),
                consensus=consensus,
            )
            for claim in CLAIMS:
                yield _row(claim, surface, diagonal, name, claim.decide(cell))
        if counted == VERTICES[0]:
            (claim,) = (claim for claim in CLAIMS if claim.decide is orders)
            for place in self.ring_places:
                curve = self._curves(place, variants, self.rings)
                cell = Cell(place[1], self.resolutions, {}, {}, {}, curve, {})
                yield _row(claim, *place, name, claim.decide(cell))

    def _errors(self, surface, diagonal, counted, variants):
        """(quantity, norm) -> errors (resolutions, 9), raised to the rounding level."""
        missing = np.full(len(self.resolutions), np.inf)
        return {
            (q, norm): np.maximum(
                [
                    self.errors.get(
                        (surface, diagonal, counted, q, norm, e, variants.get(e)), missing
                    )
                    for e in NINE
                ],
                self.levels[surface, q],
            ).T
            for q in "KH"
            for norm in ("mean", "q95", "max")
        }

    def _noise(self, surface, quantity, variants):
        keys = [(surface, quantity, e, variants.get(e)) for e in NINE]
        return np.array([self.noise.get(key, np.inf) for key in keys])

    def _curves(self, place, variants, curves):
        keys = {(q, e): (*place, q, e, variants.get(e)) for q in "KH" for e in NINE}
        return {short: curves[key] for short, key in keys.items() if key in curves}


def _row(claim, surface, diagonal, reading, decided):
    holds = {True: "true", False: "false", None: "undecided"}[decided.holds]
    first = {"claim": claim.number, "surface": surface, "diagonal": diagonal, "reading": reading}
    return first | {"holds": holds, "effect": decided.effect, "evidence": decided.evidence}


def _fits(curves, place, columns):
    """(*place, quantity, estimator, variant) -> slope, its standard error and verdict."""
    fits = curves.set_index([*place, "quantity", "estimator", "variant"])[columns]
    return dict(zip(fits.index, fits.itertuples(index=False, name=None)))


def ring_slopes(rings: pd.DataFrame) -> pd.DataFrame:
    """rings.csv: per valence, kind of ring, quantity, estimator and variant the slope of
    log(mean error) over log(1/h) on the smaller half of the sizes, its standard error, verdict."""
    key = ["valence", "ring", "quantity", "estimator", "variant"]
    by_h = rings.set_index([*key, "h"]).value.unstack("h")
    by_h = by_h.iloc[:, : (len(by_h.columns) + 1) // 2]
    x, y = -np.log(by_h.columns.to_numpy(float)), np.log(by_h.to_numpy())
    slope, stderr = slope_fit(x, y, np.ones(y.shape, dtype=bool))
    fits = {"slope": slope, "stderr": stderr, "verdict": list(map(verdict, slope))}
    return by_h.index.to_frame(index=False).assign(**fits)
