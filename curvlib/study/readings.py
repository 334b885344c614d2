"""The readings of a study: the options of each estimator, by name."""

import hashlib
import itertools
from pathlib import Path

from curvlib.comparison.norms import VERTICES
from curvlib.signatures import readings as estimator_options

# The paper's error plots by quantity: figure -> surface.
PAPER_FIGURES = {
    "K": {"figure-3": "revolution", "figure-5": "teapot_spout"},
    "H": {"figure-4": "revolution", "figure-6": "teapot_spout"},
}

# The estimators of claim 8, with the paper's normals and with exact ones: (name, reading, label).
ON_RINGS = (
    ("gauss_bonnet", {}, "Gauss-Bonnet"),
    ("paraboloid", {}, "Paraboloid, estimated normals"),
    ("paraboloid", {"normal": "exact"}, "Paraboloid, exact normals"),
)


class Readings:
    """The readings that `estimators`, `readings`, `more_readings`, `vary` and `product` define.

    A reading maps options to values. An estimator that has the option and the value takes it; any
    other keeps its default. `paraboloid_normal` is the option `normal` of paraboloid alone, and
    goes before `normal`; so for any estimator and option.
    """

    def choices(self) -> dict[str, tuple]:
        """Every option of the study's estimators, and `vertices`: its values, defaults first."""
        return choices_of(self.estimators)

    def single_changes(self) -> dict[str, dict]:
        """Name -> reading for each single value that differs from some estimator's default."""
        choices, default = self.choices(), self._effect({})
        single = [{option: value} for option in self.vary for value in choices.get(option, ())]
        return {name_of(choice): choice for choice in single if self._effect(choice) != default}

    def all_readings(self) -> dict[str, dict]:
        """The readings in the tables: those named in the config, then the single changes."""
        return Named(self.readings | self.single_changes())

    def products(self) -> dict[str, dict]:
        """Name -> joint reading for each combination of the options in `product`.

        The first value of an option of all leaves each estimator its own default: with `uniform`
        watanabe weighs by area, as printed.
        """
        choices = self.choices()
        options = [option for option in self.product if option in choices]
        values = itertools.product(*(choices[option] for option in options))
        combinations = [dict(zip(options, v)) for v in values] if options else []
        of_one = {own(stem_of(e), o) for e in self.estimators for o in estimator_options(e)}
        return Named(
            {
                name_of(choice): {
                    o: v for o, v in choice.items() if o in of_one or v != choices[o][0]
                }
                for choice in combinations
            }
        )

    def options(self, estimator: str, reading: dict) -> dict:
        """All options of an estimator in a reading: what it knows of that, else its defaults."""
        stem, chosen = stem_of(estimator), {}
        for option, values in estimator_options(estimator).items():
            value = reading.get(own(stem, option), reading.get(option))
            chosen[option] = value if value in values else values[0]
        return chosen

    def variants(self, estimator: str) -> dict[str, dict]:
        """Key -> options, distinct over all readings, the default first; each is run once."""
        every = [{}, *self.all_readings().values(), *self.products().values()]
        chosen = (self.options(estimator, reading) for reading in every)
        return Named({variant(options): options for options in chosen})

    def tabulated(self, estimator: str, readings=None) -> list[str]:
        """Keys of the variants of `readings` (names), or of all that are not products."""
        of_all = self.all_readings()
        chosen = (self.options(estimator, of_all[name]) for name in readings or of_all)
        return list(dict.fromkeys(map(variant, chosen)))

    def rows(self) -> "Rows":
        """readings.csv: reading, kind, estimator (its stem), variant, counted, more.

        `kind`: `named` in the config, a `single` change, or a `product`, which is run on the
        paper's meshes alone and in the search for an explanation alone.
        """
        # A joint reading of one option has the name of a single change, and may be another.
        of_kind = {"named": self.readings, "product": self.products()}
        single = self.single_changes()
        of_kind["single"] = {name: single[name] for name in single if name not in self.readings}
        return Rows(
            {
                "reading": name,
                "kind": kind,
                "estimator": stem_of(estimator),
                "variant": variant(self.options(estimator, reading)),
                "counted": reading.get("vertices", VERTICES[0]),
                "more": kind == "named" and name in self.more_readings,
            }
            for kind in ("named", "single", "product")
            for name, reading in of_kind[kind].items()
            for estimator in self.estimators
        )

    def ring_curves(self) -> list[tuple]:
        """The ON_RINGS that the study runs: (estimator, variant, label)."""
        files = {stem_of(estimator): estimator for estimator in self.estimators}
        return [
            (stem, key, label)
            for stem, reading, label in ON_RINGS
            if stem in files
            and (key := variant(self.options(files[stem], reading))) in self.variants(files[stem])
        ]

    def _effect(self, reading):
        """The effect of a reading: every estimator's options, and the vertices counted."""
        options = {name: self.options(name, reading) for name in self.estimators}
        return options, reading.get("vertices", VERTICES[0])


class _Brief:
    """Shown as length and digest: parameters of jobs are printed in the report."""

    def __repr__(self):
        digest = hashlib.sha256(super().__repr__().encode()).hexdigest()[:16]
        return f"{len(self)} entries, {digest}"


class Rows(_Brief, tuple):
    """Rows of a table; of a list Snakemake would make another."""


class Named(_Brief, dict):
    """Readings or options by name."""


def error_figures(study, quantity: str) -> dict[str, tuple]:
    """The error plots of a quantity, figure -> (surface, resolutions): one per surface with all
    resolutions, and the paper's with those of the full meshes."""
    every = sorted({n for _, n, _ in study.meshes()})
    stems = list(map(stem_of, study.surfaces))
    paper = {
        figure: (surface, study.resolutions)
        for figure, surface in PAPER_FIGURES[quantity].items()
        if surface in stems
    }
    return {f"error-{quantity}-{stem}": (stem, every) for stem in stems} | paper


def choices_of(names) -> dict[str, tuple]:
    """Every option of the estimators, of all and of one, and `vertices`: its values, defaults
    first."""
    found, of_one = {}, {}
    for name in names:
        for option, values in estimator_options(name).items():
            found[option] = tuple(dict.fromkeys((*found.get(option, ()), *values)))
            of_one[own(stem_of(name), option)] = values
    return found | of_one | {"vertices": VERTICES}


def own(estimator: str, option: str) -> str:
    """The name of an estimator's own option in a reading: `paraboloid_normal`."""
    return f"{estimator}_{option}"


def name_of(choice: dict) -> str:
    """The name of a reading, from its choices: `area=half,dihedral=unsigned`."""
    return ",".join(f"{option}={value}" for option, value in choice.items())


def variant(options: dict) -> str:
    """The key of an option set in result files: `area=third,dihedral=signed`."""
    return name_of(dict(sorted(options.items()))) or "-"


def stem_of(name: str) -> str:
    """The name of an estimator or surface in rules and results: a path's stem."""
    return Path(name).stem
