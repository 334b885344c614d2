"""The paper's sentences about convergence and stability."""

import itertools

import numpy as np

from .cell import FAVOURITES, NINE, Holds, tied_ranks
from .claim import Verdict, claim, from_first

# Orders half way from O(h) to O(h^2), and from O(1) to O(h).
QUADRATIC, LINEAR = 1.5, 0.5

ORDERS = "undecided: the local orders straddle it, or there are fewer than two"


@claim(
    4,
    "4",
    "Gauss-Bonnet for K and paraboloid fitting for H converge on every model.",
    "the lower of the two orders of the mean error, finest half, less 0.5",
    0,
    f"true: both local orders at least 0.5 throughout; {ORDERS}",
    about=FAVOURITES.values(),
)
def both_converge(cell):
    return _orders(cell, dict.fromkeys(FAVOURITES.items(), LINEAR))


@claim(
    5,
    "4",
    "Not every other scheme converges.",
    "how many of the other sixteen (eight for K, eight for H) stagnate or diverge",
    1,
    "true: the local orders of at least one are below 0.5 throughout; undecided: those of some "
    "straddle it",
)
def others_do_not(cell):
    keys = [key for key in itertools.product(FAVOURITES, NINE) if key not in FAVOURITES.items()]
    reached = {key: _reached(cell.curve.get(key), LINEAR) for key in keys}
    idle = [f"{name} ({q})" for (q, name), holds in reached.items() if holds == Holds.FALSE]
    holds = Holds.TRUE if idle else Holds.UNDECIDED
    if set(reached.values()) == {Holds.TRUE}:
        holds = Holds.FALSE
    words = f"{len(idle)} of {len(keys)}: " + ", ".join(sorted(idle))
    return Verdict(holds, len(idle), words, from_first(cell, holds))


@claim(
    8,
    "5, quoting Meek and Walton",
    "Paraboloid fitting has an O(h^2) error on non-uniform meshes too; Gauss-Bonnet has O(h^2) on "
    "uniform ones, else O(h).",
    "the least excess of an order for K over 1.5 (O(h^2)) or 0.5 (O(h))",
    0,
    f"true: both reached throughout, uniform meaning regular rings in space, not a grid of "
    f"parameters; {ORDERS}",
    about=FAVOURITES.values(),
)
def orders(cell):
    uniform = cell.diagonal.endswith("-regular")
    wanted = {("K", "paraboloid"): QUADRATIC}
    return _orders(cell, wanted | {("K", "gauss_bonnet"): QUADRATIC if uniform else LINEAR})


@claim(
    9,
    "5",
    "Paraboloid fitting is the most stable method: it always has a good convergence.",
    "the lower of its two orders of the mean error, finest half, less 0.5",
    0,
    f"true: both local orders at least 0.5 throughout; {ORDERS}",
    about=["paraboloid"],
)
def always_converges(cell):
    return _orders(cell, {(q, "paraboloid"): LINEAR for q in FAVOURITES})


@claim(
    12,
    "5",
    "Paraboloid fitting is the most stable method: it responds least to noise.",
    "mean rank of paraboloid by the mean change of K and of H under noise",
    1,
    "true: least (or tied) in every trial; undecided: in at least half",
)
def least_response(cell):
    if not cell.response:
        return None
    responses = np.concatenate([cell.response[q] for q in FAVOURITES])
    if not len(responses) or np.isnan(responses).any():
        return Verdict(Holds.UNDECIDED, np.nan, "no response of some of the nine")
    ranks = tied_ranks(responses)[:, NINE.index("paraboloid")]
    least = (ranks == 1).sum()
    holds = Holds.of(least == len(ranks))
    if holds == Holds.FALSE and 2 * least >= len(ranks):
        holds = Holds.UNDECIDED
    words = f"least in {least} of {len(ranks)} trials; ranks {ranks.min()} to {ranks.max()}"
    return Verdict(holds, ranks.mean(), words, from_first(cell, holds))


def _reached(curve, least) -> Holds:
    """Whether the local orders of a curve are at least a limit throughout."""
    if curve is None:
        return Holds.UNDECIDED
    if curve.verdict == "exact" or curve.low >= least:
        return Holds.TRUE
    return Holds.FALSE if curve.high < least else Holds.UNDECIDED


def _orders(cell, wanted):
    """Whether every curve reaches its limit; the effect is the least excess of an order, NaN if one
    is not known."""
    states, excess, words = [], [], []
    for (quantity, name), least in wanted.items():
        curve = cell.curve.get((quantity, name))
        states.append(_reached(curve, least))
        if curve is None:
            excess.append(np.nan)
            words.append(f"{name} ({quantity}) undefined")
        elif curve.verdict == "exact":
            words.append(f"{name} ({quantity}) exact")
        else:
            excess.append(curve.order - least)
            order, low, high = (f"{x:.2f}".replace("-0.00", "0.00") for x in curve[:3])
            words.append(f"{name} ({quantity}) order {order}, local {low} to {high}")
    holds = Holds.all(states)
    effect = np.min(excess) if excess else np.nan
    return Verdict(holds, effect, "; ".join(words), from_first(cell, holds))
