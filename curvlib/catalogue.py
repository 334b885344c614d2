"""A folder of Python files is the list of what there is: one file, one estimator or surface."""

import importlib
import importlib.util
import sys
from pathlib import Path

from curvlib.errors import InputError, check_name


class Catalogue:
    """The modules of one package, by file stem; files that start with `_` are helpers."""

    def __init__(self, what: str, folder: str):
        self.what = what
        self.folder = Path(__file__).parent / folder
        self.package = f"{__package__}.{folder}"
        self._loaded = {}

    def names(self) -> list[str]:
        """Names found in the folder, sorted."""
        return sorted(p.stem for p in self.folder.glob("*.py") if not p.stem.startswith("_"))

    def path(self, name: str) -> Path:
        """The file behind a name; a path to a .py file outside the package stands for itself.

        Raises InputError for an unknown name or a path that is not a file.
        """
        if str(name).endswith(".py"):
            path = Path(name)
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
        """The imported module behind a name or path; errors as in `path`."""
        if name in self._loaded:
            # Without a look at the folder, which would cost more than a small mesh's estimate.
            return self._loaded[name]
        path = self.path(name)
        if path.parent == self.folder:
            self._loaded[name] = importlib.import_module(f"{self.package}.{path.stem}")
            return self._loaded[name]
        # Named by its path: two strangers' files may share a stem, and compiled code that was
        # kept looks for the module by its name.
        key = f"{self.package}:{path.resolve()}"
        if key not in self._loaded:
            spec = importlib.util.spec_from_file_location(key, path)
            sys.modules[key] = module = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(module)
            self._loaded[key] = module
        return self._loaded[key]

    def modules(self, files: dict) -> dict:
        """The modules behind names or paths, by the same keys; errors as in `path`."""
        return {key: self.module(file) for key, file in files.items()}


estimators = Catalogue("estimator", "estimators")
surfaces = Catalogue("surface", "surfaces")
