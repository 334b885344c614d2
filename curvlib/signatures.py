"""What an estimator's signature says: what it is given, and its options."""

import functools
import inspect
from collections.abc import Hashable
from numbers import Integral
from typing import Annotated, get_args, get_origin

from .catalogue import estimators, peers
from .errors import InputError, check_name
from .kit.coupled import Coupled
from .kit.options import Geodesic, Length, Lengths, Option

# Valid names of an estimator's first parameter, which say what it is given.
GIVEN = ("ring", "disk", "ball", "mesh", "passes")
# Parameters of `curvlib.estimate` itself: no option can have such a name.
RESERVED = ("mesh", "estimator", "threads", "per", "creases")


def readings(estimator) -> dict[str, tuple]:
    """The options of an estimator: name -> valid values, the default first.

    Raises InputError for a parameter without a default or with the name of one of `estimate`'s.
    """
    return dict(Signature.of(*resolved(estimator)).options)


def resolved(estimator):
    """Name and function of an estimator: a name, also of a peer, a path, or the function itself."""
    if callable(estimator) and isinstance(estimator, Hashable):
        return getattr(estimator, "__name__", "estimate"), estimator
    if isinstance(estimator, str) and not estimators.holds(estimator):
        check_name("estimator", estimator, [*estimators.names(), *peers.names()])
        return estimator, peers.module(estimator).estimate
    return estimator, estimators.module(estimator).estimate


class Signature:
    """What an estimator is given, and its options.

    Attributes
    ----------
    name : str
        Of the estimator, for messages.
    function : callable
    given : str
        The name of its first parameter, one of GIVEN.
    field : Signature or None
        Of the function beside it that has the name of its second parameter, where that has no
        default.
    coupled : bool
        Whether it is annotated to return Coupled: a field that is the solution of equations.
    geodesic : bool
        Whether an option of it is a Geodesic.
    per : tuple
        "vertex", and "face" where it can be run over the centres of triangles: PER in its file.
    creases : str
        What it does at creases where nothing is asked for: CREASES in its file, "ignore" without.
    options : dict
        Name -> valid values, the default first.
    parts : dict
        Name -> the part of a length that the function is given.
    """

    @staticmethod
    @functools.cache
    def of(name, function, above=()) -> "Signature":
        """The Signature of a function, InputError where it is not one of an estimator's.

        `above`: the functions whose field it is, directly or through others.
        """
        return Signature(name, function, above)

    def __init__(self, name, function, above=()):
        self.name, self.function, self.field = name, function, None
        self.per = _globals(function).get("PER", ("vertex",))
        self.creases = _globals(function).get("CREASES", "ignore")
        try:
            # Annotations may be text: `from __future__ import annotations`.
            signature = inspect.signature(function, eval_str=True)
        except (ValueError, NameError, SyntaxError) as error:  # of a builtin; of an annotation
            raise InputError(f"estimator {name!r}: {error}") from None
        parameters = list(signature.parameters.values())
        first = parameters[0] if parameters else None
        if first is None or first.kind not in (
            first.POSITIONAL_ONLY,
            first.POSITIONAL_OR_KEYWORD,
        ):
            raise InputError(
                f"estimator {name!r}: its first parameter has to be ring, disk, ball, mesh or "
                "passes"
            )
        check_name("first parameter", first.name, GIVEN, f"estimator {name!r}")
        self.given, rest = first.name, parameters[1:]
        if rest and rest[0].default is first.empty and rest[0].kind == first.kind:
            self.field, rest = self._beside(rest[0].name, (*above, function)), rest[1:]
        self.coupled = signature.return_annotation is Coupled
        whole = [_whole(p) for p in rest]
        rest, self.parts = [p for p, _ in whole], {p.name: part for p, part in whole}
        self.geodesic = any(p.annotation is Geodesic for p in rest)
        self.options = {p.name: self._values(p) for p in rest}

    def _beside(self, name, above):
        beside = _globals(self.function).get(name)
        if callable(beside) and beside in above[:-1]:
            raise InputError(f"estimator {self.name!r}: field {name!r} would need itself")
        if not callable(beside) or beside is self.function:
            raise InputError(
                f"estimator {self.name!r}: option {name!r} has no default, and there is no "
                "function of this name beside it, to be run over all vertices first"
            )
        field = Signature.of(f"{name} of {self.name}", beside, above)
        check_name("first parameter", field.given, GIVEN[:3], f"estimator {field.name!r}")
        return field

    def _values(self, p):
        if p.kind != p.POSITIONAL_OR_KEYWORD or p.default is p.empty:
            raise InputError(f"estimator {self.name!r}: option {p.name!r} has no default")
        if p.name in RESERVED:
            raise InputError(
                f"estimator {self.name!r}: no option can be called {p.name!r}; rename it"
            )
        if p.annotation in (Length, Geodesic):
            lengths = Lengths((p.default,))
            if p.default is not None and p.default not in lengths:
                raise InputError(f"estimator {self.name!r}: {p.name}={p.default!r} is no length")
            return lengths
        values = p.default, *(v for v in get_args(p.annotation) if v != p.default)
        if self.given in ("disk", "ball") and p.name == "radius":
            raise InputError(
                f"estimator {self.name!r}: option 'radius' has to be annotated as "
                "curvlib.kit.options.Length"
            )
        if self.given == "disk" and p.name == "rings":
            for value in values:
                if not isinstance(value, Integral) or value < 1:
                    raise InputError(
                        f"estimator {self.name!r}: rings={value!r} is no number of at least 1"
                    )
        return values

    def chosen(self, options) -> dict:
        """All options, defaults included: Numba compiles anew for each set of keywords.

        Raises InputError for an unknown option or value.
        """
        chosen = {option: values[0] for option, values in self.options.items()}
        for option, value in options.items():
            check_name(f"option of {self.name}", option, self.options)
            values = self.options[option]
            if not isinstance(values, Lengths):
                check_name(f"{option} of {self.name}", value, values)
                value = values[values.index(value)]
            elif value not in values:
                raise InputError(
                    f"{option} of {self.name}: {value!r} is no length; valid: a positive number in "
                    "the unit of the mesh, or text such as '5 edges' for five mean edges"
                )
            chosen[option] = value
        return chosen

    def arguments(self, chosen, mesh, unit) -> dict:
        """Options as the function gets them: strings as Option, a Length as a number, lengths of
        the mesh being multiplied by `unit`."""
        return {
            option: Lengths.of(value, mesh, unit) * self.parts[option]
            if isinstance(self.options[option], Lengths)
            else Option(value)
            if isinstance(value, str)
            else value
            for option, value in chosen.items()
        }


def _whole(parameter):
    """A parameter without its Annotated, and which part of a Length that names."""
    if get_origin(parameter.annotation) is not Annotated:
        return parameter, 1.0
    kind, part = get_args(parameter.annotation)
    return parameter.replace(annotation=kind), part


def _globals(function):
    """The names of the file of a function, also of one that was compiled; none of a builtin's."""
    return getattr(getattr(function, "py_func", function), "__globals__", {})
