"""The paper's sentences as predicates on the tables, in our words; decided, never tuned to.

Each claim looks at a Cell: one surface, cut in one way, in one reading. It comes to a Verdict:
True, False or None (undecided), one number as its effect, and the evidence in words.
"""

from collections import namedtuple
from dataclasses import dataclass

import numpy as np

NINE = ["circular", "gauss_bonnet", "paraboloid", "taubin", "taubin_a", "taubin_b"]
NINE += ["watanabe", "watanabe_a", "watanabe_b"]
SEVEN = ["cylinder", "cone", "sphere", "revolution", "teapot_body", "teapot_spout", "ellipsoid"]

TIE = 0.02  # errors within 2 % of each other are a tie
SIMILAR, DIFFERENT = 0.7, 0.5  # Kendall's tau
QUADRATIC, LINEAR = -1.5, -0.5  # slopes nearer to O(h^2), and to O(h), than to the order below

Claim = namedtuple("Claim", "number section sentence measure limit holds cuts decide")
Verdict = namedtuple("Verdict", "holds effect evidence")
CLAIMS = []


@dataclass
class Cell:
    """What a claim looks at. `diagonal`: how it is cut; `n` (r,) the resolutions; `mean` K and H
    -> mean errors (r, 9) of the NINE; `finest` (quantity, norm) -> (9,) at the largest n; `noise`
    K and H -> (9,) mean errors under noise; `curve` (quantity, estimator) -> (tail, tail_stderr,
    verdict); `consensus` K and H -> mean ranks (9,) over the other surfaces of the SEVEN. Errors
    below rounding are raised to that level; undefined ones are infinite."""

    diagonal: str
    n: np.ndarray
    mean: dict
    finest: dict
    noise: dict
    curve: dict
    consensus: dict


def claim(section, sentence, measure, limit, holds, cuts="each"):
    """Register a predicate: where the paper says what, what is measured, at which value the claim
    turns, when it holds; `cuts` "all" where only all cuts of a surface together make it true."""

    def register(decide):
        CLAIMS.append(
            Claim(len(CLAIMS) + 1, section, sentence, measure, limit, holds, cuts, decide)
        )
        return decide

    return register


def _ratio(errors, name):
    """Error of `name` over the least of the other eight, along the last axis, and whose that is."""
    mine = NINE.index(name)
    others, rivals = np.delete(errors, mine, axis=-1), np.delete(NINE, mine)
    return errors[..., mine] / others.min(-1), rivals[others.argmin(-1)]


def chosen(surfaces) -> list:
    """Those of the SEVEN among `surfaces`, in the paper's order; all of them if there are none."""
    present = dict.fromkeys(surfaces)
    return [name for name in SEVEN if name in present] or list(present)


def _always_best(cell, quantity, name):
    ratio, rivals = _ratio(cell.mean[quantity], name)
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
    "4, 5",
    "The Gauss-Bonnet scheme is the best of the nine for K, always.",
    "mean error of K, Gauss-Bonnet over the best other",
    1,
    BEST,
)
def best_for_K(cell):
    return _always_best(cell, "K", "gauss_bonnet")


@claim(
    "4, 5",
    "Paraboloid fitting is the best of the nine for H, always.",
    "mean error of |H|, paraboloid over the best other",
    1,
    BEST,
)
def best_for_H(cell):
    return _always_best(cell, "H", "paraboloid")


@claim(
    "4",
    "K and H want different algorithms: Gauss-Bonnet for K with paraboloid for H is the best pair.",
    "the larger of the ratios of claims 1 and 2",
    1,
    "true, false or undecided as claims 1 and 2 together",
)
def best_pair(cell):
    both = best_for_K(cell), best_for_H(cell)
    best = {q: NINE[cell.mean[q][-1].argmin()] for q in "KH"}
    same = "the same" if best["K"] == best["H"] else "different ones"
    return Verdict(
        _all(v.holds for v in both),
        max(v.effect for v in both),
        f"at n = {cell.n[-1]} best for K is {best['K']}, best for H {best['H']}: {same}",
    )


@claim(
    "4",
    "Gauss-Bonnet for K and paraboloid fitting for H converge on every model.",
    "the flatter of the two slopes of log(mean error) over log(n), finest half",
    LINEAR,
    "true: both at most -0.5; undecided: within twice its standard error of that",
)
def both_converge(cell):
    return _slopes(cell, {("K", "gauss_bonnet"): LINEAR, ("H", "paraboloid"): LINEAR})


@claim(
    "4",
    "Not every other scheme converges.",
    "how many of the other sixteen (eight for K, eight for H) stagnate or diverge",
    1,
    "true: at least one",
)
def others_do_not(cell):
    favourites = {("K", "gauss_bonnet"), ("H", "paraboloid")}
    others = [key for key in cell.curve if key not in favourites]
    moving = ("converges", "exact")
    idle = sorted(f"{name} ({q})" for q, name in others if cell.curve[q, name][2] not in moving)
    return Verdict(bool(idle), len(idle), f"{len(idle)} of {len(others)}: " + ", ".join(idle))


@claim(
    "4",
    "Paraboloid fitting is always second for K, a stride behind Gauss-Bonnet.",
    "rank of paraboloid by mean error of K at the finest n",
    2,
    "true: 2 at every n; undecided: at the finest, but not at every n",
)
def second_for_K(cell):
    rank = ranks(cell.mean["K"])[:, NINE.index("paraboloid")]
    second = rank == 2
    ahead = cell.mean["K"][-1][NINE.index("paraboloid")] / cell.mean["K"][-1].min()
    return Verdict(
        True if second.all() else None if second[-1] else False,
        rank[-1],
        f"second at {second.sum()} of {len(second)} resolutions; at n = {cell.n[-1]} rank "
        f"{rank[-1]:.0f}, its error {ahead:.3g} times the least",
    )


@claim(
    "4",
    "The ranking is similar on all seven models.",
    "Kendall's tau between the ranking here and the mean ranking on the other models, the smaller "
    "of K and H",
    SIMILAR,
    f"true: at least {SIMILAR}; false: below {DIFFERENT}",
)
def similar_everywhere(cell):
    tau = {q: kendall(ranks(cell.mean[q][-1]), cell.consensus[q]) for q in "KH"}
    least = min(tau.values())
    # No tau: there are no other models, or all of them tie.
    holds = least >= SIMILAR or (False if least < DIFFERENT else None)
    return Verdict(holds, least, f"tau {tau['K']:.2f} for K, {tau['H']:.2f} for H")


@claim(
    "5, quoting Meek and Walton",
    "Paraboloid fitting has an O(h^2) error on non-uniform meshes too; Gauss-Bonnet has O(h^2) on "
    "uniform ones, else O(h).",
    "how far the slopes for K miss -1.5 (O(h^2)) or -0.5 (O(h)), the worse of the two",
    0,
    "true: both reached in all cuts of a surface; undecided: within twice its standard error",
    cuts="all",
)
def orders(cell):
    uniform = cell.diagonal in ("same", "valence-6-regular")
    wanted = {("K", "paraboloid"): QUADRATIC}
    return _slopes(cell, wanted | {("K", "gauss_bonnet"): QUADRATIC if uniform else LINEAR})


@claim(
    "5",
    "Paraboloid fitting is the most stable method.",
    "mean rank of paraboloid by the 95 % quantile and the largest error, and under noise of 1 % "
    "of an edge, for K and H",
    1,
    "true: best (or tied) in all six; undecided: in at least three",
)
def most_stable(cell):
    measures = {f"{norm} {q}": cell.finest[q, norm] for norm in ("q95", "max") for q in "KH"}
    measures |= {f"noise {q}": cell.noise[q] for q in "KH"}
    place = {m: int(ranks(e)[NINE.index("paraboloid")]) for m, e in measures.items()}
    best = sum(rank == 1 for rank in place.values())
    return Verdict(
        True if best == len(place) else None if best >= len(place) / 2 else False,
        np.mean(list(place.values())),
        "ranks: " + ", ".join(f"{label} {rank}" for label, rank in place.items()),
    )


def _slopes(cell, wanted):
    """Whether every curve's slope is at most the one wanted; effect: by how much it is missed."""
    verdicts, missed, words = [], [], []
    for (quantity, name), limit in wanted.items():
        tail, stderr, verdict = cell.curve.get((quantity, name), (np.nan, np.nan, "undefined"))
        words.append(f"{name} ({quantity}) {verdict}, slope {tail:.2f} +- {stderr:.2f}")
        if verdict == "exact":
            verdicts.append(True)
            continue
        missed.append(tail - limit)
        near = abs(tail - limit) <= 2 * np.nan_to_num(stderr)
        verdicts.append(None if near or np.isnan(tail) else bool(tail < limit))
    return Verdict(_all(verdicts), max(missed, default=np.nan), "; ".join(words))


def _all(verdicts):
    """False where one is, else undecided where one is."""
    verdicts = list(verdicts)
    return False if False in verdicts else None if None in verdicts else True


def ranks(errors):
    """Rank of each along the last axis: one more than how many are smaller by more than a tie."""
    smaller = errors[..., None, :] * (1 + TIE) < errors[..., :, None]
    return 1 + smaller.sum(-1)


def kendall(a, b):
    """Kendall's tau-b of two rankings."""
    (x, y) = (np.sign(np.subtract.outer(r, r)) for r in (a, b))
    norm = np.sqrt((x * x).sum() * (y * y).sum())
    return (x * y).sum() / norm if norm else np.nan
