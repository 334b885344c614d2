"""The claims' evidence: a Cell for every surface, cut and reading, decided and summed up."""

import numpy as np
import pandas as pd

from curvlib.comparison.accuracy import convergence, rounding_levels, slope_fit, verdict
from curvlib.comparison.norms import VERTICES

from .sentences import CLAIMS, NINE, SEVEN, Cell, chosen, orders, ranks

NOISE_SIGMA = 0.01
TOGETHER = "all"  # in place of a diagonal


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


def verdicts(decided: pd.DataFrame, diagonal: str, reading: str = "default") -> pd.DataFrame:
    """Claims against surfaces: whether each holds there, in one reading, as cut by `diagonal` or,
    where the claim is about them, in all cuts together."""
    here = _of_claims(decided[decided.reading == reading])
    here = here[here.diagonal.isin([diagonal, TOGETHER])]
    return here.pivot(index="claim", columns="surface", values="holds")


def summary(decided: pd.DataFrame, named, singles, diagonals) -> pd.DataFrame:
    """claims-summary.csv: each claim in words, how it fares on the paper's surfaces in the `named`
    readings on the first diagonal, which of the `singles` readings or diagonals turns it over,
    and on how many surfaces at most it is true in any reading and cut, with the first such."""
    on_surfaces = decided[decided.diagonal.isin(diagonals)]
    surfaces = chosen(on_surfaces.surface)
    seven = _of_claims(on_surfaces[on_surfaces.surface.isin(surfaces)])
    rows = []
    for claim in CLAIMS:
        here = seven[seven.claim == claim.number]
        at_first = here[here.diagonal.isin([diagonals[0], TOGETHER])]
        readings = {r: outcome(x) for r, x in at_first.groupby("reading")}
        cuts = {d: outcome(x) for d, x in here[here.reading == "default"].groupby("diagonal")}
        default = readings["default"]
        turned = [r for r in singles if stands(readings[r]) != stands(default)]
        turned += [f"diagonal={d}" for d, o in cuts.items() if stands(o) != stands(default)]
        every = here.groupby(["reading", "diagonal"], sort=False).holds
        most = every.agg(lambda holds: (holds == "true").sum())
        reading, diagonal = most.idxmax()
        open_on = at_first[(at_first.reading == "default") & (at_first.holds == "undecided")]
        rows.append(
            {
                "claim": claim.number,
                "section": claim.section,
                "sentence": claim.sentence,
                "measure": claim.measure,
                "limit": claim.limit,
                "holds_if": claim.holds,
                **{reading: readings[reading] for reading in named},
                "cells": len(here),
                "true": int((here.holds == "true").sum()),
                "undecided": int((here.holds == "undecided").sum()),
                "most": int(most.max()),
                "most_in": f"{reading}, diagonal={diagonal}",
                "turned_over_by": ", ".join(turned),
                "undecided_on": ", ".join(sorted(open_on.surface)),
            }
        )
    return pd.DataFrame(rows)


def _of_claims(cells):
    """The cells that count: those of a claim about all cuts of a surface are put together, false
    if it is false in one of them, else undecided if it is that in one."""
    about_all = [claim.number for claim in CLAIMS if claim.cuts == "all"]
    apart, joined = cells[~cells.claim.isin(about_all)], cells[cells.claim.isin(about_all)]
    worst = pd.Categorical(joined.holds, ["true", "undecided", "false"], ordered=True)
    key = ["claim", "surface", "reading"]
    joined = joined.assign(holds=worst).groupby(key, sort=False).holds.max().astype(str)
    return pd.concat([apart, joined.reset_index().assign(diagonal=TOGETHER)])


def outcome(cells) -> str:
    """`5 of 7`: on how many surfaces it is true; `5 (+1) of 7` where one more is undecided."""
    count = cells.holds.value_counts()
    more = f" (+{count['undecided']})" if "undecided" in count else ""
    return f"{count.get('true', 0)}{more} of {len(cells)}"


def stands(outcome: str) -> bool:
    """Whether a claim is true on more than half of the surfaces."""
    return 2 * int(outcome.split()[0]) > int(outcome.split()[-1])


def in_words(table: pd.DataFrame) -> str:
    """The same for the CHANGELOG: a line of a list per claim."""
    lines = []
    for claim in table.itertuples():
        turned = claim.turned_over_by or "no single choice"
        lines.append(
            f"* Claim {claim.claim} ({claim.sentence[:-1]}): true on {claim.default} surfaces in "
            f"the default reading, and in {claim.true} of all {claim.cells} combinations of "
            f"surface, cut and reading ({claim.undecided} undecided); turned over by {turned}.\n"
        )
    return "".join(lines)


def _shortened(listed):
    items = listed.split(", ") if listed else ["no single choice"]
    return ", ".join(items[:2]) + (f" and {len(items) - 2} more" if len(items) > 2 else "")


def answer(table: pd.DataFrame) -> str:
    """The README's answer, in Markdown, from claims-summary.csv."""
    columns = {"claim": "", "sentence": "the paper says", "default": "true on"}
    columns |= {"likely-run": "as likely run", "turned_over_by": "turned over by"}
    shown = table[[c for c in columns if c in table]].rename(columns=columns)
    shown["turned over by"] = shown["turned over by"].map(_shortened)
    return shown.to_markdown(index=False, disable_numparse=True) + "\n"
