"""The quantities that are estimated and compared, one row each.

Tables, figures, units and the article take theirs from here; a new quantity is one more row.
"""

from collections import namedtuple

import numpy as np

Quantity = namedtuple("Quantity", "symbol label unit power error")
Quantity.__doc__ = """How a quantity is written and how its error is measured.

`symbol` in axis labels, `label` in words, `unit` of the value, `power` of 1/length that it scales
with, `error` (exact (m,), estimate (m,)) -> (m,): the error at each vertex.
"""


def absolute(exact, estimate):
    """|x - x_est|."""
    return np.abs(exact - estimate)


def of_magnitudes(exact, estimate):
    """| |x| - |x_est| |, the paper's error of H, which is blind to its sign."""
    return np.abs(np.abs(exact) - np.abs(estimate))


QUANTITIES = {
    "K": Quantity("K", "Gaussian curvature K", "1/length²", 2, absolute),
    "H": Quantity("|H|", "mean curvature H", "1/length", 1, of_magnitudes),
}


def difference(name: str, symbol: str) -> str:
    """TeX of the error of a symbol that holds the quantity's name: ||H| - |H_est||."""
    estimate = symbol.replace(name, rf"{name}_\mathrm{{est}}")
    return f"$|{symbol} - {estimate}|$"
