"""The study as its config describes it: names resolved and checked before anything runs."""

import os
from dataclasses import dataclass
from pathlib import Path

from .catalogue import estimators, surfaces
from .errors import InputError, check_name
from .estimation import check_options, readings
from .library import open_archive
from .tessellation import DIAGONALS, check_resolution


@dataclass(frozen=True)
class Study:
    """What to compute, and where; `config/README.md` explains every key.

    Raises InputError, naming the key and the nearest valid name, for anything unknown.
    """

    surfaces: list
    estimators: list
    resolutions: list
    diagonals: list
    dataset_resolutions: list
    readings: dict
    library: Path
    results: Path

    def __init__(self, config: dict):
        for key in config:
            check_name("key", key, self.__dataclass_fields__, "config")
        for key in self.__dataclass_fields__:
            if key not in config:
                raise InputError(f"config: key {key!r} is missing")
            object.__setattr__(self, key, getattr(self, f"_{key}")(config[key]))

    def options(self, estimator: str, reading: str) -> dict:
        """All options of an estimator in a reading: its defaults and what the reading changes."""
        defaults = {option: values[0] for option, values in readings(estimator).items()}
        return defaults | self.readings[reading].get(Path(estimator).stem, {})

    def variants(self, estimator: str) -> dict[str, dict]:
        """The distinct option sets of an estimator over all readings, by key: each is run once."""
        all_options = (self.options(estimator, reading) for reading in self.readings)
        return {variant(options): options for options in all_options}

    def _surfaces(self, value):
        return _names("surfaces", value, surfaces)

    def _estimators(self, value):
        return _names("estimators", value, estimators)

    def _resolutions(self, value, key="resolutions"):
        for n in _list(key, value):
            check_resolution(n, f"config: {key}")
        return sorted(set(value))

    def _dataset_resolutions(self, value):
        return self._resolutions(value, "dataset_resolutions")

    def _diagonals(self, value):
        for diagonal in _list("diagonals", value):
            check_name("diagonal", diagonal, DIAGONALS, "config: diagonals")
        return list(dict.fromkeys(value))

    def _readings(self, value):
        if not isinstance(value, dict) or "default" not in value:
            raise InputError("config: readings has to map names to options, 'default' among them")
        files = {Path(e).stem: e for e in (*estimators.names(), *self.estimators)}
        for reading, changes in value.items():
            for name, options in (changes or {}).items():
                where = f"config: reading {reading!r}"
                check_name("estimator", name, files, where)
                check_options(files[name], options, where)
        return {reading: changes or {} for reading, changes in value.items()}

    def _library(self, value):
        if Path(value).suffix != ".zip":
            return _folder("library", value)
        try:
            with open_archive(value):
                return Path(value)
        except InputError as error:
            raise InputError(f"config: library: {error}") from None

    def _results(self, value):
        return _folder("results", value)


def variant(options: dict) -> str:
    """The key of an option set in result files: `area=third,dihedral=signed`."""
    return ",".join(f"{k}={v}" for k, v in sorted(options.items())) or "-"


def _list(key, value):
    if not isinstance(value, list) or not value:
        raise InputError(f"config: {key} has to be a list that is not empty, not {value!r}")
    return value


def _names(key, value, catalogue):
    if value == "all":
        return catalogue.names()
    for name in _list(key, value):
        try:
            catalogue.path(name)
        except InputError as error:
            raise InputError(f"config: {key}: {error}") from None
    return list(dict.fromkeys(value))


def _folder(key, value):
    """A folder that can be written to, or made."""
    path = Path(value)
    existing = next(p for p in (path, *path.absolute().parents) if p.exists())
    if not existing.is_dir() or not os.access(existing, os.W_OK):
        reason = "is not a folder" if not existing.is_dir() else "cannot be written to"
        raise InputError(f"config: {key}: {str(path)!r} is no good, {str(existing)!r} {reason}")
    return path
