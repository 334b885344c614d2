"""What a claim is: a sentence of the paper in our words, and a predicate on the tables.

Each predicate maps a Cell (one surface, one cut, one reading) to a Verdict: whether it holds, one
number as its effect, the evidence in words, and the resolution from which on it holds. A claim
about all surfaces together maps a list of cells. Limits are set by the sentence alone, never by the
results.
"""

from collections import namedtuple

import numpy as np

from .cell import NINE, Holds

Claim = namedtuple(
    "Claim", "number section sentence measure limit holds about together by_n decide"
)
Verdict = namedtuple("Verdict", "holds effect evidence from_n", defaults=[np.nan])
CLAIMS = {}  # by number


def claim(number, section, sentence, measure, limit, holds, about=NINE, together=False, by_n=False):
    """Register a predicate under a number.

    `section` of the paper; `measure`: what the effect is; `limit`: the effect at which the verdict
    changes; `holds`: when it is true; `about`: the estimators without which it is undecided;
    `together`: it is about all surfaces, and is given the list of their cells; `by_n`: it is
    decided at each n. A predicate returns None where its measurement was not made.
    """

    def register(decide):
        if number in CLAIMS:
            raise ValueError(f"two claims have the number {number}")
        CLAIMS[number] = Claim(
            number, section, sentence, measure, limit, holds, about, together, by_n, decide
        )
        in_order = sorted(CLAIMS.items())
        CLAIMS.clear()
        CLAIMS.update(in_order)
        return decide

    return register


def decided_at_each_n(cell, states, effect, evidence) -> Verdict:
    """The verdict from those at each n (r,): true if all are, undecided if the finest is."""
    last = states[-1]
    if last == Holds.DEGENERATE:
        return Verdict(last, np.nan, "the two least errors are at rounding level")
    if last == Holds.UNDECIDED:
        return Verdict(last, np.nan, "not all nine have an error over the same vertices")
    if last == Holds.FALSE:
        return Verdict(
            last, effect, f"true at {states.count(Holds.TRUE)} of {len(states)}; {evidence}"
        )
    failing = [i for i, s in enumerate(states) if s not in (Holds.TRUE, Holds.DEGENERATE)]
    from_n = int(cell.n[max(failing, default=-1) + 1])
    return Verdict(
        Holds.UNDECIDED if failing else Holds.TRUE,
        effect,
        f"true at {states.count(Holds.TRUE)} of {len(states)}, from n = {from_n} on; {evidence}",
        from_n,
    )


def from_first(cell, holds):
    return int(cell.n[0]) if holds == Holds.TRUE else np.nan
