"""The evidence of a claim: the paper's nine estimators on one surface, cut and reading."""

import functools
from dataclasses import dataclass

import numpy as np

NINE = ["circular", "gauss_bonnet", "paraboloid", "taubin", "taubin_a", "taubin_b"]
NINE += ["watanabe", "watanabe_a", "watanabe_b"]
FAVOURITES = {"K": "gauss_bonnet", "H": "paraboloid"}
SEVEN = ["cylinder", "cone", "sphere", "revolution", "teapot_body", "teapot_spout", "ellipsoid"]

TIE = 0.02  # errors within 2 % of each other are a tie


def chosen(surfaces) -> list:
    """The SEVEN among `surfaces`, in the paper's order; if there are none, all of `surfaces`."""
    present = dict.fromkeys(surfaces)
    return [name for name in SEVEN if name in present] or list(present)


@dataclass
class Cell:
    """One surface, cut and reading; quantities are the keys of FAVOURITES.

    `diagonal`: how the surface is cut; `n` (r,) the resolutions; `mean` quantity -> mean errors
    (r, 9) of the NINE; `finest` (quantity, norm) -> (9,) at the largest n; `noise` quantity -> (9,)
    mean errors under noise; `curve` (quantity, estimator) -> (tail, tail_stderr, verdict);
    `consensus` quantity -> mean ranks (9,) over the other surfaces of the SEVEN. Errors below
    rounding are raised to that level; undefined ones are infinite."""

    diagonal: str
    n: np.ndarray
    mean: dict
    finest: dict
    noise: dict
    curve: dict
    consensus: dict

    @functools.cached_property
    def ratios(self):
        """Quantity -> the favourite's mean error over the least of the other eight (r,), and the
        name of that other (r,)."""
        found = {}
        for quantity, favourite in FAVOURITES.items():
            mine, errors = NINE.index(favourite), self.mean[quantity]
            others, rivals = np.delete(errors, mine, axis=-1), np.delete(NINE, mine)
            found[quantity] = errors[:, mine] / others.min(-1), rivals[others.argmin(-1)]
        return found

    @functools.cached_property
    def ranks(self):
        """Quantity -> ranks by mean error (r, 9)."""
        return {quantity: tied_ranks(errors) for quantity, errors in self.mean.items()}


def tied_ranks(errors):
    """Ranks along the last axis: 1 + the number of errors that are smaller by more than TIE."""
    smaller = errors[..., None, :] * (1 + TIE) < errors[..., :, None]
    return 1 + smaller.sum(-1)


def kendall(a, b):
    """Kendall's tau-b of two rankings; NaN where either ties throughout."""
    return _kendall(tuple(a), tuple(b))


# Kept: most readings share their rankings, and SciPy takes 0.2 ms a pair.
@functools.cache
def _kendall(a, b):
    from scipy.stats import kendalltau

    # SciPy divides twice, so that 0.5 becomes 0.4999999999999999, below DIFFERENT.
    return round(float(kendalltau(a, b).statistic), 14)
