"""Loops compiled by Numba: without Python's lock, and kept on disk for the next process.

A compiled function reads like the sums it computes, and runs at the speed of memory. It is also
Python: with NUMBA_DISABLE_JIT=1 in the environment it runs as it stands, to be debugged.
Floating-point operations keep their order and are never fused, so the same bytes come out
whatever the vector instructions of the machine, but for arctangents, which are the C library's.

It takes longer to import than all of curvlib: what needs it is imported where it is called.
"""

import hashlib
import os
import tempfile
import warnings
from pathlib import Path

import numba
from numba.core import config

PACKAGE = Path(__file__).parents[1]


def compiled(function):
    """The function, compiled when first called with arguments of some types.

    A file of estimators from elsewhere may use it as those of the package do.
    """
    given = config.CACHE_DIR
    # Numba looks for changes in the function's own file alone, not in those that it calls:
    # another state of the package has another folder.
    config.CACHE_DIR = _FOLDER or given
    try:
        jit = numba.njit(
            nogil=True, no_cfunc_wrapper=True, error_model="numpy", cache=_FOLDER is not None
        )
        return jit(function)
    finally:
        config.CACHE_DIR = given


def _folder():
    """Where compiled code of this state of the package is kept; None where it cannot be."""
    code = hashlib.sha256()
    for path in sorted(PACKAGE.rglob("*.py")):
        source = path.read_bytes()
        if b"import compiled" in source:
            code.update(source)
    try:
        base = config.CACHE_DIR or os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
        folder = Path(base, "curvlib", code.hexdigest()[:16])
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except (OSError, RuntimeError) as error:  # the latter where there is no home
        warnings.warn(
            f"compiled code cannot be kept ({error}), so that each process takes some seconds to "
            "compile it; name a folder in NUMBA_CACHE_DIR",
            stacklevel=2,
        )
        return None
    return str(folder)


_FOLDER = _folder()
