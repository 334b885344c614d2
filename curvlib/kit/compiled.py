"""Loops compiled by Numba: without Python's lock, and kept on disk for the next process.

A compiled function reads like the sums it computes, and runs at the speed of memory. It is also
Python: with NUMBA_DISABLE_JIT=1 in the environment it runs as it stands, to be debugged.
Floating-point operations keep their order and are never fused, so the same bytes come out
whatever the vector instructions of the machine, but for arctangents, which are the C library's.

Importing Numba costs more than the rest of curvlib, so modules that need it are imported inside
functions.
"""

import functools
import hashlib
import os
import re
import shutil
import time
import uuid
import warnings
from contextlib import suppress
from pathlib import Path

import numba
from numba.core import caching, codegen, compiler, config, sigutils, types, typing
from numba.core.compiler_lock import global_compiler_lock
from numba.core.runtime import rtsys

PACKAGE = Path(__file__).parents[1]
UNUSED = 30 * 24 * 3600  # seconds after which code of another state of the package is removed


def compiled(function):
    """The function, compiled when first called with arguments of some types.

    A file of estimators from elsewhere may use it as those of the package do. The machine code is
    kept in NUMBA_CACHE_DIR, XDG_CACHE_HOME or ~/.cache; where it cannot be kept, or is damaged,
    it is compiled again.

    Numba compiles each kind of call once more for every array type, and a comparison of strings,
    an assignment to a slice, a reduction such as x.max() or an expression of whole arrays costs
    it 0.3 to 1.5 s: loops over elements are compiled in a tenth of that.
    """
    return _compiled(function, _Part, counted=True)


def kernel(function):
    """As `compiled`, for a function that a loop calls at each vertex or that is such a loop.

    It is inlined into compiled functions that call it, and references to arrays are not counted in
    it: calls and atomic operations would take half of the time of a loop over disks. It cannot make
    arrays, but parts of one that it is given (`curvlib.kit.parts.part`).
    """
    return _compiled(function, _Inlined, counted=False)


def _compiled(function, library, counted):
    held = [getattr(cell.cell_contents, "py_func", None) for cell in function.__closure__ or ()]
    inner = [f for f in held if f]
    if inner:
        function.__qualname__ = f"{function.__name__}_{_identity(inner)}"
    # No function is called through a C pointer, for which Numba would compile a second wrapper.
    options = {"nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True}
    # Set in any case: else it would be that of the function which this one is compiled for.
    jit = numba.njit(**options, _nrt=counted)(function)
    if config.DISABLE_JIT:
        return jit
    if all(Path(f.__code__.co_filename).exists() for f in (function, *inner)) and _folder():
        jit._cache = _Kept(function)
    parts = _Parts(jit, library)
    jit.get_call_template, jit.get_overload = parts.get_call_template, parts.get_overload
    return jit


class _Part(codegen.JITCodeLibrary):
    """LLVM code of a function that other compiled functions call.

    It is optimised and emitted within those that call it, and there alone: Numba would do so once
    more for the function itself, and for each function between the two.
    """

    def _optimize_final_module(self):
        pass

    def _finalize_final_module(self):
        self._finalize_dynamic_globals()
        self._verify_declare_only_symbols()
        self._finalized = True


class _Inlined(_Part):
    """A part that is inlined whatever its size."""

    def _optimize_final_module(self):
        for function in self._final_module.functions:
            if not function.is_declaration and self.name in function.name:
                function.add_function_attribute("alwaysinline")


class _Parts:
    """The code of one function for its callers, by argument types."""

    def __init__(self, jit, library):
        self.jit, self.library, self.overloads = jit, library, {}

    def get_call_template(self, args, kws):
        """As `Dispatcher.get_call_template`."""
        pysig, args = self.jit._compiler.fold_argument_types(args, kws)
        args = tuple(map(_for_all, args))
        self._compile(args)
        signatures = [code.signature for code, _ in self.overloads.values()]
        name = self.jit.py_func.__name__
        template = typing.make_concrete_template(f"CallTemplate({name})", name, signatures)
        return template, pysig, args, {}

    def get_overload(self, signature):
        """As `Dispatcher.get_overload`: what the function is known by to those that call it."""
        args, _ = sigutils.normalize_signature(signature)
        return self.overloads[tuple(args)][1]

    def _compile(self, args):
        with global_compiler_lock:
            if args in self.overloads:
                return
            target, flags = self.jit.targetdescr, compiler.Flags()
            target.options.parse_as_flags(flags, self.jit.targetoptions)
            flags.no_compile = flags.no_cpython_wrapper = flags.no_cfunc_wrapper = True
            context = target.target_context
            code = compiler.compile_extra(
                target.typing_context,
                context,
                self.jit.py_func,
                args=args,
                return_type=None,
                flags=flags,
                locals={},
                library=self.library(context.codegen(), self.jit.py_func.__qualname__),
            )
            key = object()
            context.insert_user_function(key, code.fndesc, [code.library])
            self.overloads[args] = code, key


def _for_all(kind):
    """The type of all numbers for that of a constant, for which code is compiled only once."""
    if isinstance(kind, types.UniTuple):
        return type(kind)(_for_all(kind.dtype), kind.count)
    number = isinstance(kind, (types.IntegerLiteral, types.BooleanLiteral))
    return types.unliteral(kind) if number else kind


def _identity(functions):
    """What tells the functions in a closure from others, and from other states of their files."""
    text = hashlib.sha256()
    for f in functions:
        path = Path(f.__code__.co_filename)
        text.update(repr((f.__module__, f.__qualname__, f.__code__.co_firstlineno)).encode())
        text.update(path.read_bytes() if path.exists() else b"")
    return text.hexdigest()[:16]


def is_kept(function) -> bool:
    """Whether machine code of a compiled function is on disk; true where none can be kept."""
    cache = function._cache
    return not isinstance(cache, _Kept) or Path(cache._cache_file._index_path).exists()


class _Kept(caching.FunctionCache):
    """Machine code of one function on disk; a file that cannot be read or written is no error."""

    def _index_key(self, sig, codegen):
        # Numba would pickle the functions in a closure, with numbers of this process: they are
        # part of its __qualname__, and so of the file's name.
        return sig, codegen.magic_tuple()

    class _impl_class(caching.CompileResultCacheImpl):
        class _Locator(caching.UserWideCacheLocator):
            def __init__(self, py_func, py_file):
                super().__init__(py_func, py_file)
                self._cache_path = str(_folder() / self.get_suitable_cache_subpath(py_file))

            @classmethod
            def from_function(cls, py_func, py_file):
                return cls(py_func, py_file)  # makes no folder before there is something to keep

            def ensure_cache_path(self):
                _remove_unused(_folder())
                super().ensure_cache_path()

        _locator_classes = (_Locator,)

    def load_overload(self, sig, target_context):
        _mark_as_used(_folder())
        try:
            # Numba would import all that it compiles with, which takes as long as Numba itself:
            # it does so, too, when it compiles.
            rtsys.initialize(target_context)
            with self._guard_against_spurious_io_errors():
                found = self._load_overload(sig, target_context)
        except Exception:  # a file that was cut short may unpickle into any error
            with suppress(OSError):
                self.flush()
            return None
        # Of two processes that write at a time, one may have taken the other's file name.
        return found if found and found.signature.args == tuple(sig) else None

    def save_overload(self, sig, data):
        try:
            super().save_overload(sig, data)
        except OSError as error:
            _warn(error)


@functools.cache
def _folder():
    """Where compiled code of this state of the package is kept; None where there is no home."""
    # Numba looks for changes in the function's own file alone, not in those that it calls:
    # another state of the package has another folder.
    code = hashlib.sha256()
    for path in sorted(PACKAGE.rglob("*.py")):
        source = path.read_bytes()
        if re.search(rb"\bcompiled import\b|\bnumba\b", source):
            code.update(source)
    try:
        return cache_folder() / code.hexdigest()[:16]
    except RuntimeError as error:
        _warn(error)
        return None


def cache_folder() -> Path:
    """Where compiled code is kept: `curvlib` in NUMBA_CACHE_DIR, XDG_CACHE_HOME or ~/.cache.

    Raises RuntimeError where there is no home folder.
    """
    base = config.CACHE_DIR or os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base, "curvlib")


@functools.cache
def _mark_as_used(folder):
    """Once a process: the time by which `_remove_unused` judges."""
    with suppress(OSError):
        os.utime(folder)


@functools.cache
def _remove_unused(folder):
    """Once a process that makes the folder of a new state: remove those that none has used."""
    if folder.exists():
        return
    with suppress(OSError):
        for other in folder.parent.iterdir():
            old = other.stat().st_mtime < time.time() - UNUSED
            if old and re.fullmatch(r"[0-9a-f]{16}(\.[0-9a-f]{32})?", other.name):
                # Renamed first: no process finds half of it, and of several one removes it.
                gone = other.rename(other.with_name(f"{other.name[:16]}.{uuid.uuid4().hex}"))
                shutil.rmtree(gone, ignore_errors=True)


def _warn(error):
    if not _warned:
        _warned.append(error)
        warnings.warn(
            f"compiled code cannot be kept ({error}), so that each process takes some seconds to "
            "compile it; name a folder in NUMBA_CACHE_DIR",
            stacklevel=2,
        )


_warned = []
