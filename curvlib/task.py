"""An estimator with its options, and what it returned."""

import threading

import numpy as np

from .catalogue import estimators
from .errors import InputError
from .kit.batch import scatter
from .kit.tensor import ERRORS, Assessed, Curvatures

OURS = f"{estimators.package}."
# Power of 1/length that each quantity scales with.
POWERS = {"K": 2, "H": 1, "k1": 1, "k2": 1, "d1": 0, "d2": 0}
POWERS |= {name: POWERS[name.removesuffix("_error")] for name in ERRORS}


class Task:
    """An estimator with its options, the arrays that it returned, scattered to the vertices, and
    what it says that it chose.

    `per`: "vertex", or "face" where the estimator is run over the centres of triangles.
    """

    def __init__(self, signature, options, mesh, per):
        self.name, self.function = signature.name, signature.function
        self.given, self.per = signature.given, per
        self.ours = getattr(self.function, "__module__", "").startswith(OURS)
        self.arrays, self.choice, self._lock = {}, None, threading.Lock()
        self.count = len(mesh.vertices if per == "vertex" else mesh.faces)
        self.signature, self.chosen = signature, signature.chosen(options)

    def arguments(self, mesh, unit=1.0) -> dict:
        """The options as the estimator takes them."""
        return self.signature.arguments(self.chosen, mesh, unit)

    def store(self, returned, at, start, end, unit):
        """Scatter the values returned for the vertices at[start:end]; `unit` as in `gather`."""
        for name, values in zip(self._names(returned), returned):
            if name == "choice":
                self.choice = values
            if values is None or name == "choice":
                continue
            values = self._checked(name, values, end - start)
            target = self.arrays.get(name)
            if target is None:
                target = self._target(name, values.ndim)
            if values.ndim == 1:
                scatter(values, at, start, target, unit, POWERS[name])
            else:
                for component, column in zip(values, target.T):
                    scatter(component, at, start, column, unit, POWERS[name])

    def _target(self, name, dimensions):
        with self._lock:  # the first block to finish allocates
            if name not in self.arrays:
                shape = (self.count, 3) if dimensions == 2 else self.count
                self.arrays[name] = np.full(shape, np.nan)
        return self.arrays[name]

    def _names(self, returned):
        """The names of the values that were returned; InputError where they are something else."""
        names = getattr(returned, "_fields", ("K", "H"))
        known = isinstance(returned, tuple) and names in (
            ("K", "H"),
            Curvatures._fields,
            Assessed._fields,
        )
        if not known or len(returned) != len(names):
            raise InputError(
                f"estimator {self.name!r} has to return K and H, not {type(returned).__name__}; "
                "or curvlib.kit.tensor.Curvatures"
            )
        return names

    def _checked(self, name, values, count):
        """The array (count,), or (3, count) of a direction; InputError for anything else."""
        expected = (3, count) if name in ("d1", "d2") else (count,)
        try:
            found = np.asarray(values)
        except ValueError as error:
            raise InputError(f"estimator {self.name!r}: {name}: {error}") from None
        if found.shape != expected or found.dtype.kind not in "biuf":
            raise InputError(
                f"estimator {self.name!r} returned an array of shape {found.shape} of "
                f"{found.dtype} as {name}, expected {expected} of float64"
            )
        return np.asarray(found, dtype=float, order="C")
