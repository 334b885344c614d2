"""The quantities that are estimated and compared, one row each.

Tables, figures, units and the article take theirs from here; a new quantity is one more row.
"""

from collections import namedtuple

import numpy as np

Quantity = namedtuple("Quantity", "symbol label unit power error distance")
Quantity.__doc__ = """How a quantity is written and how its error is measured.

`symbol` in axis labels, `label` in words, `unit` of the value, `power` of 1/length that it scales
with, `error` (exact (m,), estimate (m,)) -> (m,): the error at each vertex; `distance`: the same
between any two values, blind to no sign. Directions are (m, 3).
"""

# A direction is compared where (k1 - k2) / (|k1| + |k2|) exceeds this: at an umbilic of the surface
# it is undefined, and near one any error of the tensor turns it.
NEARLY_UMBILIC = 0.05


def absolute(exact, estimate):
    """|x - x_est|."""
    return np.abs(exact - estimate)


def of_magnitudes(exact, estimate):
    """| |x| - |x_est| |, the paper's error of H, which is blind to its sign."""
    return np.abs(np.abs(exact) - np.abs(estimate))


def angle(exact, estimate):
    """Degrees in [0, 90] between directions (..., 3), which have no sense: d1 and -d1 are one."""
    along = np.abs((exact * estimate).sum(-1))
    across = np.linalg.norm(np.cross(exact, estimate), axis=-1)
    return np.degrees(np.arctan2(across, along))


QUANTITIES = {
    "K": Quantity("K", "Gaussian curvature K", "1/length²", 2, absolute, absolute),
    "H": Quantity("|H|", "mean curvature H", "1/length", 1, of_magnitudes, absolute),
    "k1": Quantity("k1", "larger principal curvature k1", "1/length", 1, absolute, absolute),
    "k2": Quantity("k2", "smaller principal curvature k2", "1/length", 1, absolute, absolute),
    "d1": Quantity("d1", "direction d1 of k1", "degrees", 0, angle, angle),
}


def compared(exact, estimates) -> dict:
    """Quantity -> (exact, estimated) values for those that the estimator returns and whose exact
    values are known.

    `exact`: a Mesh; `estimates`: Estimates on it. K and H alone have no k1 and k2 of their own:
    those that follow from them are undefined where H^2 < K, and add nothing. Exact directions are
    NaN where the surface is nearly umbilic.
    """
    both = {
        name: (getattr(exact, name), getattr(estimates, name))
        for name in QUANTITIES
        if name in estimates.returned
    }
    return {
        name: (_without_umbilics(values, exact), estimated)
        for name, (values, estimated) in both.items()
        if values is not None
    }


def _without_umbilics(values, exact):
    if values.ndim == 1:
        return values
    apart = exact.k1 - exact.k2 > NEARLY_UMBILIC * (np.abs(exact.k1) + np.abs(exact.k2))
    return np.where(apart[:, None], values, np.nan)


def defined(values):
    """(m,) bool of values (m,) or directions (m, 3): all numbers are finite."""
    finite = np.isfinite(values)
    return finite if finite.ndim == 1 else finite.all(1)


def difference(name: str, symbol: str) -> str:
    """TeX of the error of a symbol that holds the quantity's name: ||H| - |H_est||."""
    estimate = symbol.replace(name, rf"{name}_\mathrm{{est}}")
    return f"$|{symbol} - {estimate}|$"
