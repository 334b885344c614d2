"""Catalogues of estimators, peers, library functions, surfaces: the files of a folder each."""

import importlib
import importlib.util
import os
import re
import sys
import traceback
from pathlib import Path
from types import SimpleNamespace

from curvlib.errors import InputError, check_name

# Styles of estimators that name none: colours and markers that no file of the package has.
COLOURS = ("#A6761D", "#66A61E", "#E7298A", "#7570B3")
MARKERS = ("1", "2", "3", "4", "H")
LINES = ("-", "--", ":")


class Catalogue:
    """The modules of one package, by file stem; files that start with `_` are helpers."""

    def __init__(self, what: str, folder: str, *needs: str):
        """`needs`: the names that every file has to define."""
        self.what = what
        self.folder = Path(__file__).parent / folder
        self.package = f"{__package__}.{folder}"
        self._needs = needs
        self._loaded = {}
        self._stamps = {}
        self._shown = {}

    def names(self) -> list[str]:
        """Names of the files in the package's folder, sorted.

        Returns
        -------
        list of str

        Examples
        --------
        >>> import curvlib
        >>> "gauss_bonnet" in curvlib.estimators()
        True
        >>> "libigl_principal" in curvlib.peers()
        True
        >>> "cone" in curvlib.surfaces()
        True
        """
        return sorted(p.stem for p in self.folder.glob("*.py") if not p.stem.startswith("_"))

    def holds(self, name: str) -> bool:
        """Whether a name is that of a file in the package, or a path; cheaper than to list all."""
        ours = name.isidentifier() and name[0] != "_" and (self.folder / f"{name}.py").is_file()
        return ours or _is_path(name)

    def path(self, name: str) -> Path:
        """The file behind a name; a path to a .py file outside the package is returned as it is.

        Raises InputError for an unknown name or a path that is not a file.
        """
        if _is_path(name):
            path = Path(os.path.expanduser(name))
            if not path.is_file():
                raise InputError(f"{self.what} file {str(name)!r} does not exist")
            if path.stem in self.names():
                raise InputError(
                    f"{self.what} file {str(name)!r} has the name of one in the package; rename it"
                )
            return path
        check_name(self.what, name, self.names())
        return self.folder / f"{name}.py"

    def module(self, name: str):
        """The imported module behind a name or path; a changed file is imported again.

        Raises InputError as `path` does, and where the file fails or lacks its function.
        """
        if isinstance(name, str) and name in self._loaded:
            # Listing the folder would cost more than an estimate on a small mesh.
            return self._loaded[name]
        if _is_path(name):
            return self._from_elsewhere(name)
        self._shown[str(self.path(name))] = name
        key = f"{self.package}.{name}"
        self._loaded[name] = self._checked(lambda: importlib.import_module(key), name)
        return self._loaded[name]

    def modules(self, files: dict) -> dict:
        """The modules behind names or paths, by the same keys, with LABEL and STYLE for figures.

        A file without STYLE gets one by its position. Raises InputError as `module` does, for a
        file without LABEL, and for two files of one STYLE.
        """
        found, given = {}, {}
        for position, (key, file) in enumerate(files.items()):
            module = self.module(file)
            self._check(module, file, ("LABEL",))
            style = getattr(module, "STYLE", None) or {}
            if not isinstance(style, dict):
                raise InputError(
                    f"{self.what} file {str(file)!r}: STYLE has to be a dict for matplotlib, "
                    f"such as {_style(position)}, not {style!r}"
                )
            same = [other for other, its in given.items() if style and its == style]
            if same:
                raise InputError(f"{self.what}s {same[0]} and {file} have one STYLE; change it")
            given[file] = style
            found[key] = SimpleNamespace(**vars(module) | {"STYLE": style or _style(position)})
        return found

    def told(self, error: Exception) -> InputError | None:
        """A one-line InputError for an exception raised in a loaded file; None for any other.

        The line number is that of the innermost frame in such a file; Numba's typing errors have
        no frame there, but name file and line in their message.
        """
        frames = traceback.walk_tb(error.__traceback__)
        places = [(file, line) for file in self._shown for line in _lines_named(file, str(error))]
        places += [(frame.f_code.co_filename, line) for frame, line in frames]
        if isinstance(error, SyntaxError):
            places.append((error.filename, error.lineno))
        for file, line in reversed(places):
            if file in self._shown:
                where = f"{self.what} {self._shown[file]}, line {line}"
                return InputError(f"{where}: {type(error).__name__}: {_in_one_line(error)}")
        # Of an unknown name Numba says no line; the package's own files compile.
        theirs = [shown for shown in self._shown.values() if _is_path(shown)]
        if theirs and type(error).__module__.startswith("numba."):
            return InputError(f"{self.what} {theirs[-1]}: {_in_one_line(error)}")
        return None

    def _from_elsewhere(self, name):
        """The module of a path, loaded again where the file has changed since."""
        path = os.path.abspath(os.path.expanduser(name))
        # Named by its path: two strangers' files may share a stem, and Numba's kept code finds its
        # module by name.
        key = f"{self.package}:{path}"
        try:
            stamp = os.stat(path).st_mtime_ns, os.stat(path).st_size
        except OSError:
            stamp = None
        if stamp is None or self._stamps.get(key) != stamp:
            self.path(name)
            self._shown[path] = name
            self._loaded[key] = self._checked(lambda: _executed(key, path), name)
            self._stamps[key] = stamp
        return self._loaded[key]

    def _checked(self, load, name):
        try:
            module = load()
        except InputError:
            raise
        except (Exception, SystemExit) as error:
            unknown = f"{self.what} {name}: {type(error).__name__}: {error}"
            raise self.told(error) or InputError(unknown) from error
        self._check(module, name, self._needs)
        return module

    def _check(self, module, name, needs):
        missing = [need for need in needs if not hasattr(module, need)]
        if missing:
            every = " and ".join(dict.fromkeys(("LABEL", *self._needs)))
            raise InputError(
                f"{self.what} file {str(name)!r} has no {' and no '.join(missing)}: it has to hold "
                f"{every}"
            )
        for need in needs:
            value = getattr(module, need)
            if not (isinstance(value, str) if need == "LABEL" else callable(value)):
                kind = "text" if need == "LABEL" else "a function"
                raise InputError(
                    f"{self.what} file {str(name)!r}: {need} has to be {kind}, not {value!r}"
                )


def _is_path(name):
    return str(name).endswith(".py")


def _executed(key, path):
    """The module of a file, from its source: a .pyc does not notice an edit within a second."""
    spec = importlib.util.spec_from_file_location(key, path)
    sys.modules[key] = module = importlib.util.module_from_spec(spec)
    try:
        exec(spec.loader.source_to_code(Path(path).read_bytes(), path), vars(module))
    except BaseException:
        del sys.modules[key]
        raise
    return module


def _style(position):
    """The style of an estimator without STYLE; 60 positions differ."""
    return {
        "color": COLOURS[position % len(COLOURS)],
        "marker": MARKERS[position % len(MARKERS)],
        "linestyle": LINES[position // 20 % len(LINES)],
    }


def _lines_named(file, message):
    """Line numbers after the file's path in a message of Numba's."""
    return [int(n) for n in re.findall(re.escape(file) + r" \((\d+)\)", message)]


def _in_one_line(error):
    """The first informative line of a message."""
    text = error.msg if isinstance(error, SyntaxError) else str(error)
    lines = filter(None, map(str.strip, text.splitlines()))
    # Numba's first line names the pass that failed.
    return next((line for line in lines if not line.startswith("Failed in nopython mode")), "")


estimators = Catalogue("estimator", "estimators", "estimate")
peers = Catalogue("peer", "peers", "returned", "estimate")
libraries = Catalogue("library function", "libraries", "LABEL", "values")
surfaces = Catalogue("surface", "surfaces", "LABEL", "build")
implicit = Catalogue("implicit surface", "implicit", "LABEL", "level")
families = Catalogue("family", "families", "LABEL", "make")
