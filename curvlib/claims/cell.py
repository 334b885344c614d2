"""The evidence of a claim: the paper's nine estimators on one surface, cut and reading."""

import enum
import functools
from collections import namedtuple
from dataclasses import dataclass, field

import numpy as np

NINE = ["circular", "gauss_bonnet", "paraboloid", "taubin", "taubin_a", "taubin_b"]
NINE += ["watanabe", "watanabe_a", "watanabe_b"]
FAVOURITES = {"K": "gauss_bonnet", "H": "paraboloid"}
SEVEN = ["cylinder", "cone", "sphere", "revolution", "teapot_body", "teapot_spout", "ellipsoid"]
# Surfaces so much alike that their rankings are not two independent observations.
SIMILAR_PAIRS = [("cylinder", "cone"), ("sphere", "ellipsoid"), ("teapot_body", "teapot_spout")]

TIE = 0.02  # errors within 2 % of each other are a tie

Orders = namedtuple("Orders", "order low high verdict")
Orders.__doc__ = """Order of convergence over the finest half: overall, and the range of the local
ones (NaN for fewer than three points); the verdict of curves.csv."""


class Holds(enum.StrEnum):
    """A verdict on a claim, from the worst to the best."""

    FALSE = "false"
    UNDECIDED = "undecided"
    DEGENERATE = "degenerate"  # nothing to rank: the two best errors are at rounding level
    TRUE = "true"

    @classmethod
    def of(cls, truth) -> "Holds":
        return cls.TRUE if truth else cls.FALSE

    @classmethod
    def all(cls, verdicts) -> "Holds":
        """The conjunction: the worst of the verdicts."""
        return min(verdicts, key=list(cls).index)


def chosen(surfaces) -> list:
    """The SEVEN among `surfaces`, in the paper's order; if there are none, all of `surfaces`."""
    present = dict.fromkeys(surfaces)
    return [name for name in SEVEN if name in present] or list(present)


@dataclass
class Cell:
    """One surface, cut and reading; quantities are the keys of FAVOURITES.

    `surface`; `diagonal`: how it is cut; `n` (r,) the resolutions; `mean` quantity -> mean errors
    (r, 9) of the NINE, NaN where an estimator has none or one over fewer vertices than another;
    `vertices` quantity -> (r,) how many the means are over; `level` quantity -> the error up to
    which it is rounding; `curve` (quantity, estimator) -> Orders; `response` quantity -> (t, 9)
    mean responses to noise in the trials, empty where there are none."""

    surface: str
    diagonal: str
    n: np.ndarray
    mean: dict
    vertices: dict
    level: dict
    curve: dict
    response: dict = field(default_factory=dict)

    @functools.cached_property
    def errors(self):
        """Quantity -> mean errors (r, 9), those below rounding raised to its level."""
        return {q: np.maximum(mean, self.level[q]) for q, mean in self.mean.items()}

    @functools.cached_property
    def complete(self):
        """Quantity -> (r,) bool: all nine have an error over the same vertices."""
        return {q: np.isfinite(mean).all(-1) for q, mean in self.mean.items()}

    @functools.cached_property
    def degenerate(self):
        """Quantity -> (r,) bool: the two least errors are rounding."""
        return {
            q: np.sort(errors, axis=-1)[:, 1] <= self.level[q] for q, errors in self.errors.items()
        }

    @functools.cached_property
    def ratios(self):
        """Quantity -> the favourite's error over the least of the other eight (r,), and the name
        of that other (r,)."""
        found = {}
        for quantity, favourite in FAVOURITES.items():
            mine, errors = NINE.index(favourite), self.errors[quantity]
            others, rivals = np.delete(errors, mine, axis=-1), np.delete(NINE, mine)
            found[quantity] = errors[:, mine] / others.min(-1), rivals[others.argmin(-1)]
        return found

    @functools.cached_property
    def ranks(self):
        """Quantity -> ranks by mean error (r, 9)."""
        return {quantity: tied_ranks(errors) for quantity, errors in self.errors.items()}

    @functools.cached_property
    def best(self):
        """Quantity -> name of the estimator with the least error at the finest n."""
        return {q: NINE[errors[-1].argmin()] for q, errors in self.errors.items()}

    def ranking(self, quantity):
        """The ranks at the finest n, (9,) as a tuple; None if degenerate or an error is missing."""
        if self.degenerate[quantity][-1] or not self.complete[quantity][-1]:
            return None
        return tuple(self.ranks[quantity][-1].tolist())

    def states(self, truths, *quantities) -> list[Holds]:
        """Verdicts at each n on a statement about the ranking by some quantities, true where
        `truths` (r,) is, unless it is degenerate or an error is missing."""
        states = list(map(Holds.of, truths))
        for quantity in quantities:
            for i in np.flatnonzero(self.degenerate[quantity]):
                states[i] = Holds.DEGENERATE
        for quantity in quantities:
            for i in np.flatnonzero(~self.complete[quantity]):
                states[i] = Holds.UNDECIDED
        return states


def tied_ranks(errors):
    """Ranks along the last axis: 1 + the number of errors that are smaller by more than TIE."""
    smaller = errors[..., None, :] * (1 + TIE) < errors[..., :, None]
    return 1 + smaller.sum(-1)


# Kept: most readings share their rankings, and SciPy takes 0.2 ms a pair.
@functools.cache
def kendall_tau(a: tuple, b: tuple) -> float:
    """Kendall's tau-b of two rankings; NaN where either ties throughout."""
    from scipy.stats import kendalltau

    # SciPy divides twice, so that 0.5 becomes 0.4999999999999999.
    return round(float(kendalltau(a, b).statistic), 14)


@functools.cache
def kendall_w(rankings: tuple) -> float:
    """Kendall's coefficient of concordance of at least two rankings (tuples): 1 if all agree, 0 if
    they have nothing in common. NaN for fewer, and where all tie throughout."""
    from scipy.stats import friedmanchisquare

    judges, items = len(rankings), len(rankings[0]) if rankings else 0
    if judges < 2 or all(len(set(ranking)) == 1 for ranking in rankings):
        return np.nan
    # Friedman's statistic, corrected for ties, is W times judges (items - 1).
    statistic = friedmanchisquare(*np.transpose(rankings)).statistic
    return round(float(statistic) / (judges * (items - 1)), 14)
