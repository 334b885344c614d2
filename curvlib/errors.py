"""What a user did wrong, said in one line."""

from difflib import get_close_matches


class InputError(ValueError):
    """Bad input: the message names what is wrong, where, and what would be right."""


def check_name(what: str, name: str, valid, where: str = "") -> None:
    """Raise InputError unless `name` is in `valid`; name the nearest valid one."""
    valid = list(valid)
    if name in valid:
        return
    near = get_close_matches(str(name), valid, n=1, cutoff=0.0)
    hint = f"did you mean {near[0]!r}? " if near else ""
    place = f"{where}: " if where else ""
    raise InputError(f"{place}unknown {what} {name!r}; {hint}valid: {', '.join(valid)}")
