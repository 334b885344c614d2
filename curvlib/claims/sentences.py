"""The paper's sentences as predicates on the tables, in our words.

Each predicate maps a Cell (one surface, one cut, one reading) to a Verdict: True, False or None
(undecided), one number as its effect, and the evidence in words. Limits are set by the sentence
alone, never by the results.
"""

from collections import namedtuple

import numpy as np

from .cell import FAVOURITES, NINE, TIE, kendall, tied_ranks

SIMILAR, DIFFERENT = 0.7, 0.5  # Kendall's tau
QUADRATIC, LINEAR = -1.5, -0.5  # slopes half way from O(h^2) to O(h), and from O(h) to O(1)

Claim = namedtuple("Claim", "number section sentence measure limit holds about cuts decide")
Verdict = namedtuple("Verdict", "holds effect evidence")
CLAIMS = {}  # by number


def claim(number, section, sentence, measure, limit, holds, about=NINE, cuts="each"):
    """Register a predicate under a number.

    `section` of the paper; `measure`: what the effect is; `limit`: the effect at which the verdict
    changes; `holds`: when it is true; `about`: the estimators without which it is undecided;
    `cuts="all"`: it must hold on every cut of a surface.
    """

    def register(decide):
        if number in CLAIMS:
            raise ValueError(f"two claims have the number {number}")
        CLAIMS[number] = Claim(
            number, section, sentence, measure, limit, holds, about, cuts, decide
        )
        return decide

    return register


def _always_best(cell, quantity):
    ratio, rivals = cell.ratios[quantity]
    best = ratio <= 1 + TIE
    holds = True if best.all() else None if best[-1] else False
    return Verdict(
        holds,
        ratio[-1],
        f"best at {best.sum()} of {len(best)} resolutions; at n = {cell.n[-1]} its error is "
        f"{ratio[-1]:.3g} times that of {rivals[-1]}, the best other",
    )


BEST = f"true: at most 1 + {TIE} at every n; undecided: at the finest, but not at every n"


@claim(
    1,
    "4, 5",
    "The Gauss-Bonnet scheme is the best of the nine for K, always.",
    "mean error of K, Gauss-Bonnet over the best other",
    1,
    BEST,
)
def best_for_K(cell):
    return _always_best(cell, "K")


@claim(
    2,
    "4, 5",
    "Paraboloid fitting is the best of the nine for H, always.",
    "mean error of |H|, paraboloid over the best other",
    1,
    BEST,
)
def best_for_H(cell):
    return _always_best(cell, "H")


@claim(
    3,
    "4",
    "K and H want different algorithms: Gauss-Bonnet for K with paraboloid for H is the best pair.",
    "the larger of the ratios of claims 1 and 2",
    1,
    "true, false or undecided as claims 1 and 2 together",
)
def best_pair(cell):
    both = best_for_K(cell), best_for_H(cell)
    best = {q: NINE[cell.mean[q][-1].argmin()] for q in FAVOURITES}
    same = "the same" if best["K"] == best["H"] else "different ones"
    return Verdict(
        _all(v.holds for v in both),
        np.max([v.effect for v in both]),
        f"at n = {cell.n[-1]} best for K is {best['K']}, best for H {best['H']}: {same}",
    )


@claim(
    4,
    "4",
    "Gauss-Bonnet for K and paraboloid fitting for H converge on every model.",
    "the flatter of the two slopes of log(mean error) over log(n), finest half",
    LINEAR,
    "true: both at most -0.5; undecided: within twice its standard error of that",
    about=FAVOURITES.values(),
)
def both_converge(cell):
    return _slopes(cell, dict.fromkeys(FAVOURITES.items(), LINEAR))


@claim(
    5,
    "4",
    "Not every other scheme converges.",
    "how many of the other sixteen (eight for K, eight for H) stagnate or diverge",
    1,
    "true: at least one",
)
def others_do_not(cell):
    others = [key for key in cell.curve if key not in FAVOURITES.items()]
    moving = ("converges", "exact")
    idle = sorted(f"{name} ({q})" for q, name in others if cell.curve[q, name][2] not in moving)
    return Verdict(bool(idle), len(idle), f"{len(idle)} of {len(others)}: " + ", ".join(idle))


@claim(
    6,
    "4",
    "Paraboloid fitting is always second for K, a stride behind Gauss-Bonnet.",
    "rank of paraboloid by mean error of K at the finest n",
    2,
    "true: 2 at every n; undecided: at the finest, but not at every n",
)
def second_for_K(cell):
    rank = cell.ranks["K"][:, NINE.index("paraboloid")]
    second = rank == 2
    ahead = cell.mean["K"][-1][NINE.index("paraboloid")] / cell.mean["K"][-1].min()
    return Verdict(
        True if second.all() else None if second[-1] else False,
        rank[-1],
        f"second at {second.sum()} of {len(second)} resolutions; at n = {cell.n[-1]} rank "
        f"{rank[-1]:.0f}, its error {ahead:.3g} times the least",
    )


@claim(
    7,
    "4",
    "The ranking is similar on all seven models.",
    "Kendall's tau between the ranking here and the mean ranking on the other models, the smaller "
    "of K and H",
    SIMILAR,
    f"true: at least {SIMILAR}; false: below {DIFFERENT}",
)
def similar_everywhere(cell):
    tau = {q: kendall(cell.ranks[q][-1], cell.consensus[q]) for q in FAVOURITES}
    # Without other models, or where all ranks tie, tau is NaN.
    each = (True if t >= SIMILAR else False if t < DIFFERENT else None for t in tau.values())
    words = ", ".join(f"{t:.2f} for {q}" for q, t in tau.items())
    return Verdict(_all(each), np.min(list(tau.values())), f"tau {words}")


@claim(
    8,
    "5, quoting Meek and Walton",
    "Paraboloid fitting has an O(h^2) error on non-uniform meshes too; Gauss-Bonnet has O(h^2) on "
    "uniform ones, else O(h).",
    "how far the slopes for K miss -1.5 (O(h^2)) or -0.5 (O(h)), the worse of the two",
    0,
    "true: both reached in all cuts of a surface; undecided: within twice its standard error",
    about=FAVOURITES.values(),
    cuts="all",
)
def orders(cell):
    uniform = cell.diagonal in ("same", "valence-6-regular")
    wanted = {("K", "paraboloid"): QUADRATIC}
    return _slopes(cell, wanted | {("K", "gauss_bonnet"): QUADRATIC if uniform else LINEAR})


@claim(
    9,
    "5",
    "Paraboloid fitting is the most stable method.",
    "mean rank of paraboloid by the 95 % quantile and the largest error, and under noise of 1 % "
    "of an edge, for K and H",
    1,
    "true: best (or tied) in all six; undecided: in at least three",
)
def most_stable(cell):
    both = tuple(FAVOURITES)
    measures = {f"{norm} {q}": cell.finest[q, norm] for norm in ("q95", "max") for q in both}
    measures |= {f"noise {q}": cell.noise[q] for q in both}
    rank = {m: int(tied_ranks(e)[NINE.index("paraboloid")]) for m, e in measures.items()}
    best = sum(r == 1 for r in rank.values())
    return Verdict(
        True if best == len(rank) else None if best >= len(rank) / 2 else False,
        np.mean(list(rank.values())),
        "ranks: " + ", ".join(f"{label} {r}" for label, r in rank.items()),
    )


def _slopes(cell, wanted):
    """Whether every curve's slope is at most its limit; the effect is the largest excess."""
    verdicts, missed, words = [], [], []
    for (quantity, name), limit in wanted.items():
        tail, stderr, verdict = cell.curve.get((quantity, name), (np.nan, np.nan, "undefined"))
        words.append(f"{name} ({quantity}) {verdict}, slope {tail:.2f} +- {stderr:.2f}")
        if verdict == "exact":
            verdicts.append(True)
            continue
        missed.append(tail - limit)
        near = abs(tail - limit) <= (2 * stderr if stderr >= 0 else 0)  # NaN: two points
        verdicts.append(None if near or np.isnan(tail) else bool(tail < limit))
    return Verdict(_all(verdicts), np.max(missed) if missed else np.nan, "; ".join(words))


def _all(verdicts):
    """The conjunction: False if one is, else None if one is."""
    verdicts = list(verdicts)
    return False if False in verdicts else None if None in verdicts else True
