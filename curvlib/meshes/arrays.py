"""Arrays of a mesh: checked, of one type, read only."""

import numpy as np

from curvlib.errors import InputError


def frozen(array):
    """A read-only view: the caller's own array stays writeable."""
    view = array.view()
    view.flags.writeable = False
    return view


def any_array(name, value):
    """An array of any type; InputError where it is none."""
    try:
        return np.asarray(value)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name}: not an array of numbers ({error})") from None


def numbers(name, value, kind, copy):
    """A C-contiguous array of float or int; InputError where there is none of it."""
    array = any_array(name, value)
    allowed = "iuf" if kind is float else "iu"
    if array.size and array.dtype.kind not in allowed:
        words = "numbers" if kind is float else "integers"
        raise InputError(f"{name}: an array of {words} is expected, not {array.dtype}")
    return np.array(array, dtype=kind, order="C", copy=True if copy else None)
