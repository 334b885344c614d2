"""The study as its config describes it: names resolved and checked before anything runs."""

import itertools
import os
from dataclasses import dataclass
from pathlib import Path

from curvlib.catalogue import estimators, surfaces
from curvlib.comparison.norms import VERTICES
from curvlib.errors import InputError, check_name
from curvlib.estimation import readings as estimator_options
from curvlib.files import open_archive
from curvlib.nurbs.tessellation import check_cut, check_resolution


@dataclass(frozen=True)
class Study:
    """What to compute, and where; `config/README.md` explains every key.

    Raises InputError, naming the key and the nearest valid name, for anything unknown.
    """

    surfaces: list
    estimators: list
    resolutions: list
    diagonals: list
    more: list
    readings: dict
    more_readings: list
    vary: list
    product: list
    library: Path
    results: Path

    def __init__(self, config: dict):
        for key in config:
            check_name("key", key, self.__dataclass_fields__, "config")
        for key in self.__dataclass_fields__:
            if key not in config:
                raise InputError(f"config: key {key!r} is missing")
            object.__setattr__(self, key, getattr(self, f"_{key}")(config[key]))

    def meshes(self) -> list[tuple]:
        """(diagonal, n, whether all readings are run on it) of every mesh of a surface; on the
        others it is those of `more_readings`."""
        every = list(itertools.product(self.diagonals, self.resolutions))
        more = [
            mesh
            for block in self.more
            for mesh in itertools.product(block["diagonals"], block["resolutions"])
        ]
        return [(*m, True) for m in every] + [(*m, False) for m in more if m not in every]

    def choices(self) -> dict[str, tuple]:
        """Every option of any estimator, and `vertices`: its values, defaults first."""
        found = {}
        for name in dict.fromkeys((*estimators.names(), *self.estimators)):
            for option, values in estimator_options(name).items():
                found[option] = tuple(dict.fromkeys((*found.get(option, ()), *values)))
        return found | {"vertices": VERTICES}

    def single_changes(self) -> dict[str, dict]:
        """A reading, by name, for each value that differs from some estimator's default."""
        result = {}
        for option in self.vary:
            for value in self.choices()[option]:
                choice = {option: value}
                if self.changes(choice):
                    result[f"{option}={value}"] = choice
        return result

    def all_readings(self) -> dict[str, dict]:
        """The readings of the tables: those of the config, then the single changes."""
        return self.readings | self.single_changes()

    def products(self) -> dict[str, dict]:
        """A reading, by name, for each combination of the options in `product`."""
        values = [self.choices()[option] for option in self.product]
        combinations = [dict(zip(self.product, v)) for v in itertools.product(*values)]
        names = (",".join(f"{k}={v}" for k, v in c.items()) for c in combinations)
        return dict(zip(names, combinations)) if self.product else {}

    def named_products(self) -> dict[str, str]:
        """The products that some of the `readings` come to: product -> reading."""
        products = self.products()
        default = {option: self.choices()[option][0] for option in self.product}
        return {
            product: name
            for name, reading in self.readings.items()
            for product, choice in products.items()
            if choice == default | reading
        }

    def changes(self, reading: dict) -> bool:
        """Whether a reading differs from the default one."""
        default = {name: self.options(name, {}) for name in self.estimators}
        changed = {name: self.options(name, reading) for name in self.estimators}
        return changed != default or reading.get("vertices", VERTICES[0]) != VERTICES[0]

    def options(self, estimator: str, reading: dict) -> dict:
        """All options of an estimator in a reading: what it knows of that, else its defaults."""
        known = estimator_options(estimator)
        return {
            option: reading[option] if reading.get(option) in values else values[0]
            for option, values in known.items()
        }

    def variants(self, estimator: str) -> dict[str, dict]:
        """The distinct options of an estimator over all readings, by key, the default's first:
        each is run once."""
        every = [{}, *self.all_readings().values(), *self.products().values()]
        chosen = (self.options(estimator, reading) for reading in every)
        return {variant(options): options for options in chosen}

    def more_variants(self, estimator: str) -> list[str]:
        """The keys of those variants that are run on every mesh."""
        chosen = (self.options(estimator, self.readings[name]) for name in self.more_readings)
        return list(dict.fromkeys(map(variant, chosen)))

    def _surfaces(self, value):
        return _names("surfaces", value, surfaces)

    def _estimators(self, value):
        return _names("estimators", value, estimators)

    def _resolutions(self, value, where="resolutions"):
        for n in _list(where, value):
            check_resolution(n, f"config: {where}")
        return sorted(set(value))

    def _diagonals(self, value, where="diagonals"):
        for diagonal in _list(where, value):
            check_cut(diagonal, f"config: {where}")
        return list(dict.fromkeys(value))

    def _more(self, value):
        keys = ("diagonals", "resolutions")
        for block in value:
            if not isinstance(block, dict) or sorted(block) != sorted(keys):
                raise InputError(f"config: more: {block!r} needs exactly {' and '.join(keys)}")
        return [
            {key: getattr(self, f"_{key}")(block[key], f"more: {key}") for key in keys}
            for block in value
        ]

    def _readings(self, value):
        if not isinstance(value, dict) or value.get("default", 0) not in ({}, None):
            raise InputError("config: readings maps names to choices; 'default' has to make none")
        valid = self.choices()
        for name, choices in value.items():
            for option, chosen in (choices or {}).items():
                check_name("option", option, valid, f"config: reading {name!r}")
                check_name(option, chosen, valid[option], f"config: reading {name!r}")
        return {name: choices or {} for name, choices in value.items()}

    def _more_readings(self, value):
        for name in _list("more_readings", value):
            check_name("reading", name, self.readings, "config: more_readings")
        if "default" not in value:
            raise InputError("config: more_readings has to hold 'default'")
        return value

    def _vary(self, value, where="vary"):
        for option in value:
            check_name("option", option, self.choices(), f"config: {where}")
        return value

    def _product(self, value):
        return self._vary(value, "product")

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
