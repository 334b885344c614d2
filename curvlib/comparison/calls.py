"""The calls of estimators that are surveyed and timed: each with its defaults, some with others."""

from collections import namedtuple
from pathlib import Path

from curvlib.signatures import Signature, resolved

# Further options by estimator.
FURTHER = {
    "ball_regression": [{"radius": "3 edges"}],
    "compact_hermite": [{"degree": 4}],
    "corrected_measures": [{"radius": "3 edges"}, {"normals": "fit", "radius": "3 edges"}],
    "jet": [{"degree": 3}, {"degree": 4, "rings": 3}, {"degree": 6, "rings": 3}],
    "normal_cycle": [{"radius": "3 edges"}],
    "pooled_deficit": [{"rings": 3}],
    "quadric": [{"rings": 3}],
    "tensor_voting": [{"directions": "fitted"}],
}


class Call(namedtuple("Call", "estimator options")):
    """An estimator, its name or path, with options; written as `jet(degree=4, rings=3)`."""

    __slots__ = ()

    def __str__(self):
        options = ", ".join(f"{option}={value}" for option, value in self.options.items())
        name = Path(self.estimator).stem
        return f"{name}({options})" if options else name

    @property
    def neighbourhood(self) -> str:
        """How far the estimator sees, in words."""
        signature = Signature.of(*resolved(self.estimator))
        chosen = signature.chosen(self.options)
        if chosen.get("radius") is not None:
            return f"radius {chosen['radius']}"
        coupled = signature.field and signature.field.coupled
        if signature.given in ("mesh", "passes") or coupled:
            return "mesh"
        rings = chosen.get("rings", 1)
        return f"{rings} ring{'s' if rings > 1 else ''}" + (", twice" if signature.field else "")


def calls(names) -> list[Call]:
    """The calls of estimators, by name or path, in the order of `names`."""
    return [Call(name, options) for name in names for options in ({}, *FURTHER.get(name, ()))]
