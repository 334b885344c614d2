"""The study as its config describes it: types and names checked before anything runs."""

import functools
import itertools
import os
import re
from pathlib import Path

from curvlib.catalogue import estimators, surfaces
from curvlib.errors import InputError, check_name
from curvlib.files import expanded, open_archive
from curvlib.nurbs.tessellation import check_cut, check_resolution

from .readings import Readings, choices_of, stem_of

SCHEMA = Path(__file__).with_name("config.schema.yaml")

# The name of the reading that the search of joint readings adds.
FOUND = "best-explanation"

# Numbers that --config delivers as text, and the advice in the error message.
AS_NUMBERS = re.compile(r"[\d.,\s\[\]]+")
AS_TEXT = ", which is text: --config delivers no numbers, a file for --configfile does"


class Study(Readings):
    """A study: one attribute per key of its config, which `config/README.md` explains.

    Raises InputError with the key of a value of the wrong type, and with the nearest valid name of
    an unknown one.
    """

    def __init__(self, config: dict):
        _check_types(config)
        self.surfaces = _names("surfaces", config["surfaces"], surfaces)
        self.estimators = _names("estimators", config["estimators"], estimators)
        _check_stems([*self.estimators, *self.surfaces])
        self.resolutions = _resolutions("resolutions", config["resolutions"])
        self.diagonals = _cuts("diagonals", config["diagonals"])
        self.more = [
            {
                "diagonals": _cuts("more: diagonals", block["diagonals"]),
                "resolutions": _resolutions("more: resolutions", block["resolutions"]),
            }
            for block in config["more"]
        ]
        self.readings = {name: choice or {} for name, choice in config["readings"].items()}
        if FOUND in self.readings:
            raise InputError(f"config: readings: {FOUND!r} is what the search finds; rename it")
        self.more_readings = config["more_readings"]
        self.vary, self.product = config["vary"], config["product"]
        try:
            self._check_options(self.choices())
        except InputError:
            # An overlay with some of the nine inherits all readings of config.yaml, so that options
            # of the package's other estimators are valid too. Looked up last: it loads them all.
            names = dict.fromkeys((*self.estimators, *estimators.names()))
            self._check_options(choices_of(names))
        for name in self.more_readings:
            check_name("reading", name, self.readings, "config: more_readings")
        self.frontier = _resolutions("frontier", config["frontier"])
        self.library = _library(config["library"])
        self.results = _folder("results", config["results"])
        self.benchmark = config["benchmark"]

    def is_that_of(self, config: dict) -> bool:
        """Whether another config describes the same study, apart from the folders."""
        return vars(self) == vars(self._here(config))

    def meshes(self) -> list[tuple]:
        """(diagonal, n, full) of every mesh of a surface. Full meshes get every reading, the others
        only `more_readings`."""
        every = list(itertools.product(self.diagonals, self.resolutions))
        more = [
            mesh
            for block in self.more
            for mesh in itertools.product(block["diagonals"], block["resolutions"])
        ]
        return [(*m, True) for m in every] + [(*m, False) for m in more if m not in every]

    def check_places(self, config: dict) -> None:
        """Raise InputError if an overlay would overwrite files of the study of `config`.

        A study that differs only in estimators or readings may share the meshes.
        """
        if self.results.resolve() == Path(config["results"]).resolve():
            raise InputError(
                f"config: results: the tables of the study of config.yaml lie in "
                f"{str(self.results)!r}; an overlay has to name a folder of its own, such as "
                "results/mine"
            )
        same_folder = self.library.resolve() == Path(config["library"]).resolve()
        if same_folder and self.meshes() != self._here(config).meshes():
            raise InputError(
                f"config: library: the meshes of the study of config.yaml lie in "
                f"{str(self.library)!r}; an overlay with other resolutions or diagonals has to "
                "name a folder of its own, such as data/mine"
            )

    def _check_options(self, known):
        for name, choice in self.readings.items():
            for option, value in choice.items():
                check_name("option", option, known, f"config: reading {name!r}")
                check_name(option, value, known[option], f"config: reading {name!r}")
        for key, options in (("vary", self.vary), ("product", self.product)):
            for option in options:
                check_name("option", option, known, f"config: {key}")

    def _here(self, config):
        """The study of another config with the folders of this one."""
        return Study(config | {"library": str(self.library), "results": str(self.results)})


def _check_types(config):
    """Raise InputError for an unknown or missing key and for a value of the wrong type."""
    from jsonschema import Draft202012Validator

    schema = _schema()
    for key in config:
        check_name("key", key, schema["properties"], "config")
    for key in schema["properties"]:
        if key not in config:
            raise InputError(f"config: key {key!r} is missing")
    for error in Draft202012Validator(schema).iter_errors(config):
        where = "config: " + ": ".join(part for part in error.path if isinstance(part, str))
        wanted, value = error.schema["description"], error.instance
        text = AS_TEXT if isinstance(value, str) and AS_NUMBERS.fullmatch(value) else ""
        if isinstance(error.path[-1], int):
            raise InputError(f"{where}: {value!r} has to be {wanted}{text}")
        raise InputError(f"{where} has to be {wanted}, not {value!r}{text}")


@functools.cache
def _schema():
    import yaml

    return yaml.safe_load(SCHEMA.read_text(encoding="utf-8"))


def _names(key, value, catalogue):
    """Names and paths, `all` replaced by the names in the folder, each file checked."""
    names = []
    for name in [value] if value == "all" else value:
        if name == "all":
            names += catalogue.names()
        else:
            names.append(os.path.expanduser(name) if name.endswith(".py") else name)
    names = list(dict.fromkeys(names))
    try:
        catalogue.modules({name: name for name in names})
    except InputError as error:
        raise InputError(f"config: {key}: {error}") from error
    return names


def _check_stems(names):
    """Raise InputError if two files have one stem, their name in rules and results."""
    files = {}
    for name in names:
        other = files.setdefault(stem_of(name), name)
        if other is not name:
            raise InputError(f"config: two files are called {stem_of(name)!r}: {other} and {name}")


def _resolutions(key, value):
    for n in map(int, value):
        check_resolution(n, f"config: {key}")
    return sorted(set(map(int, value)))


def _cuts(key, value):
    for diagonal in value:
        check_cut(diagonal, f"config: {key}")
    return list(dict.fromkeys(value))


def _library(value):
    if Path(value).suffix != ".zip":
        return _folder("library", value)
    path = _path("library", value)
    if not path.exists():
        raise InputError(f"config: library: {str(path)!r} does not exist")
    try:
        with open_archive(path):
            return path
    except InputError as error:
        raise InputError(f"config: library: {error}") from None


def _folder(key, value):
    """The path of a folder; InputError if it cannot be written to or made."""
    path = _path(key, value)
    existing = next(p for p in (path, *path.absolute().parents) if p.exists())
    if not existing.is_dir() or not os.access(existing, os.W_OK):
        reason = "is not a folder" if not existing.is_dir() else "cannot be written to"
        raise InputError(f"config: {key}: {str(path)!r} is no good, {str(existing)!r} {reason}")
    return path


def _path(key, value):
    if "{" in value or "}" in value:
        raise InputError(f"config: {key}: {value!r} has a brace, Snakemake's sign of a wildcard")
    try:
        return expanded(value)
    except InputError as error:
        raise InputError(f"config: {key}: {error}") from None
