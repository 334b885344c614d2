"""The paper's sentences about rankings."""

import itertools

import numpy as np

from .cell import FAVOURITES, NINE, SIMILAR_PAIRS, TIE, Holds, kendall_w
from .claim import Verdict, claim, decided_at_each_n, from_first

# Kendall's W: strong agreement, and moderate (Schmidt 1997, on Delphi surveys).
STRONG, MODERATE = 0.7, 0.5

BY_N = "true: at every n; undecided: at the finest, but not at every n"
BEST = f"{BY_N}; best: at most 1 + {TIE} times the best other"


def _best(cell, quantity, tie=TIE):
    return cell.states(cell.ratios[quantity][0] <= 1 + tie, quantity)


def always_best(cell, quantity, tie=TIE) -> Verdict:
    """Whether the favourite for a quantity is the best, or within a tie of it, at every n."""
    ratio, rivals = cell.ratios[quantity]
    return decided_at_each_n(
        cell,
        _best(cell, quantity, tie),
        ratio[-1],
        f"at n = {cell.n[-1]} its error is {ratio[-1]:.3g} times that of {rivals[-1]}, the best "
        f"other, over {cell.vertices[quantity][-1]:.0f} vertices",
    )


@claim(
    1,
    "4, 5",
    "The Gauss-Bonnet scheme is the best of the nine for K, always.",
    "mean error of K, Gauss-Bonnet over the best other, at the finest n",
    1,
    BEST,
    by_n=True,
)
def best_for_K(cell):
    return always_best(cell, "K")


@claim(
    2,
    "4, 5",
    "Paraboloid fitting is the best of the nine for H, always.",
    "mean error of |H|, paraboloid over the best other, at the finest n",
    1,
    BEST,
    by_n=True,
)
def best_for_H(cell):
    return always_best(cell, "H")


@claim(
    3,
    "4",
    "Hence K and H want different algorithms: Gauss-Bonnet for K with paraboloid for H is the best "
    "pair (follows from 1 and 2).",
    "the larger of the ratios of claims 1 and 2",
    1,
    "as claims 1 and 2 together",
    by_n=True,
)
def best_pair(cell):
    states = map(Holds.all, zip(_best(cell, "K"), _best(cell, "H")))
    best = cell.best
    same = "the same" if best["K"] == best["H"] else "different ones"
    return decided_at_each_n(
        cell,
        list(states),
        np.max([cell.ratios[q][0][-1] for q in FAVOURITES]),
        f"at n = {cell.n[-1]} best for K is {best['K']}, best for H {best['H']}: {same}",
    )


@claim(
    6,
    "4",
    "Paraboloid fitting is always second for K, a stride behind Gauss-Bonnet.",
    "rank of paraboloid by mean error of K at the finest n",
    2,
    f"{BY_N}; second: rank 2, and Gauss-Bonnet first",
    by_n=True,
)
def second_for_K(cell):
    ranks = {name: cell.ranks["K"][:, NINE.index(name)] for name in ("gauss_bonnet", "paraboloid")}
    second = (ranks["paraboloid"] == 2) & (ranks["gauss_bonnet"] == 1)
    errors = cell.errors["K"][-1]
    ahead = errors[NINE.index("paraboloid")] / errors.min()
    return decided_at_each_n(
        cell,
        cell.states(second, "K"),
        ranks["paraboloid"][-1],
        f"at n = {cell.n[-1]} rank {ranks['paraboloid'][-1]}, its error {ahead:.3g} times the "
        f"least, that of {NINE[errors.argmin()]}",
    )


@claim(
    7,
    "4",
    "The ranking is similar on all seven models.",
    "Kendall's W of the rankings at the finest n over the surfaces that are not degenerate, the "
    "smaller of K and H",
    STRONG,
    f"true: W at least {STRONG}, also without one surface of each similar pair; false: below "
    f"{MODERATE}",
    together=True,
)
def similar_everywhere(cells):
    states, words, effects = [], [], []
    for quantity in FAVOURITES:
        rankings = {cell.surface: cell.ranking(quantity) for cell in cells}
        ranked = {surface: ranking for surface, ranking in rankings.items() if ranking}
        all_of_them = kendall_w(tuple(ranked.values()))
        without = [
            kendall_w(tuple(ranking for name, ranking in ranked.items() if name not in left_out))
            for left_out in itertools.product(*SIMILAR_PAIRS)
        ]
        every = np.array([all_of_them, *without])
        if np.isnan(every).any():
            states.append(Holds.UNDECIDED)
        elif (every >= STRONG).all():
            states.append(Holds.TRUE)
        else:
            states.append(Holds.FALSE if (every < MODERATE).all() else Holds.UNDECIDED)
        effects.append(all_of_them)
        words.append(
            f"W = {all_of_them:.2f} for {quantity} over {len(ranked)} surfaces, {min(without):.2f} "
            f"to {max(without):.2f} without one of each similar pair"
        )
    holds = Holds.all(states)
    return Verdict(holds, np.min(effects), "; ".join(words), from_first(cells[0], holds))


@claim(
    10,
    "4",
    "Two algorithms outperform the rest: Gauss-Bonnet and paraboloid fitting.",
    "the larger, of K and H, of the ratios of the better of the two over the best other, at the "
    "finest n",
    1,
    f"{BY_N}; outperform: for K and for H one of the two is the best, at most 1 + {TIE} times the "
    "best other",
    by_n=True,
)
def two_best(cell):
    two = [NINE.index(name) for name in FAVOURITES.values()]
    ratios = np.array(
        [
            cell.errors[q][:, two].min(-1) / np.delete(cell.errors[q], two, axis=-1).min(-1)
            for q in FAVOURITES
        ]
    )
    return decided_at_each_n(
        cell,
        cell.states(ratios.max(0) <= 1 + TIE, *FAVOURITES),
        ratios[:, -1].max(),
        f"at n = {cell.n[-1]} best for K is {cell.best['K']}, best for H {cell.best['H']}",
    )


def _mean_ranks(cell):
    """Ranks (r, 9) by the mean rank for K and H."""
    mean = (cell.ranks["K"] + cell.ranks["H"]) / 2
    return 1 + (mean[:, None, :] < mean[:, :, None]).sum(-1), mean


@claim(
    11,
    "4",
    "If only one method may be chosen, it is paraboloid fitting.",
    "rank of paraboloid by the mean rank for K and H at the finest n",
    1,
    f"{BY_N}; the choice: the least mean rank, or tied",
    by_n=True,
)
def single_choice(cell):
    ranks, mean = _mean_ranks(cell)
    rank = ranks[:, NINE.index("paraboloid")]
    return decided_at_each_n(
        cell, cell.states(rank == 1, *FAVOURITES), rank[-1], _best_ranked(cell, mean)
    )


def _best_ranked(cell, mean):
    first = np.argsort(mean[-1], kind="stable")[:3]
    return f"mean ranks at n = {cell.n[-1]}: " + ", ".join(
        f"{NINE[i]} {mean[-1, i]:g}" for i in first
    )
