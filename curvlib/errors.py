"""What a user did wrong, said in one line."""

from collections.abc import Hashable
from difflib import get_close_matches


class InputError(ValueError):
    """Bad input: the message names what is wrong, where, and what would be right."""


class MeshWarning(UserWarning):
    """A mesh without values at many of its vertices: the message counts them and says why."""


def check_name(what: str, name: str, valid, where: str = "") -> None:
    """Raise InputError unless `name` is in `valid`; name the valid one nearest to a string."""
    valid = list(valid)
    # An array would be compared element by element.
    if isinstance(name, Hashable) and name in valid:
        return
    near = get_close_matches(name, valid, n=1, cutoff=0.0) if isinstance(name, str) else ()
    hint = f"did you mean {near[0]!r}? " if near else ""
    place = f"{where}: " if where else ""
    raise InputError(f"{place}unknown {what} {name!r}; {hint}valid: {', '.join(map(str, valid))}")
