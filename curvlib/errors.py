"""Errors and warnings about a user's input, in one line."""

from collections.abc import Hashable
from difflib import get_close_matches


class InputError(ValueError):
    """Bad input. The message names the fault, its place, and the nearest valid value.

    Examples
    --------
    >>> import curvlib
    >>> try:
    ...     curvlib.surface("spere")
    ... except curvlib.InputError as error:
    ...     print(str(error).partition(";")[0])
    unknown surface 'spere'
    """


class MeshWarning(UserWarning):
    """A mesh that leaves many vertices without a value, or values to rounding; the message counts
    the vertices and names the causes."""


def check_name(what: str, name: str, valid, where: str = "") -> None:
    """Raise InputError, with the nearest valid name, unless `name` is in `valid`."""
    valid = list(valid)
    # An array would be compared element by element.
    if isinstance(name, Hashable) and name in valid:
        return
    names = [v for v in valid if isinstance(v, str)]
    near = get_close_matches(name, names, n=1, cutoff=0.0) if isinstance(name, str) else ()
    hint = f"did you mean {near[0]!r}? " if near else ""
    place = f"{where}: " if where else ""
    listed = ", ".join(map(str, valid)) or "none"
    raise InputError(f"{place}unknown {what} {name!r}; {hint}valid: {listed}")
