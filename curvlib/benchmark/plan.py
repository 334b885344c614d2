"""The plan of the benchmark, as its config describes it: types and names checked before it runs."""

from pathlib import Path

from curvlib.catalogue import estimators, families, peers
from curvlib.comparison.calls import Call, calls
from curvlib.errors import InputError, check_name
from curvlib.meshes.noise import KINDS

SCHEMA = Path(__file__).with_name("plan.schema.yaml")
NOISE = "noise-"  # begins the names of parts with noise


class Plan:
    """One attribute per key of the config, which `config/README.md` explains.

    Raises InputError with the key of a value of the wrong type, and with the nearest valid name of
    an unknown one.
    """

    def __init__(self, path):
        self.path = Path(path)
        config = _read(self.path)
        _check_types(config, self.path)
        self.estimators = _names("estimators", config["estimators"], estimators)
        self.peers = _names("peers", config["peers"], peers)
        self.families = _names("families", config["families"], families)
        self.seed, self.cost, self.noise = config["seed"], config["cost"], config["noise"]
        self.published_2020 = config["published_2020"]
        self._resolutions, self._own = config["resolutions"], config["own_resolutions"]
        for name in self._own:
            check_name("family", name, families.names(), f"{path}: own_resolutions")
        check_name("family", self.noise["family"], families.names(), f"{path}: noise")
        made = families.module(self.noise["family"]).SURFACES
        for name in self.noise["surfaces"]:
            check_name("surface", name, made, f"{path}: noise: surfaces")
        for kind in self.noise["kinds"]:
            check_name("kind of noise", kind, KINDS, f"{path}: noise: kinds")

    @property
    def parts(self) -> list[str]:
        """The parts that a job runs each: families, and kinds of noise after `noise-`."""
        return [*self.families, *(NOISE + kind for kind in self.noise["kinds"])]

    def resolutions(self, family: str) -> list[int]:
        """n of the meshes of a family."""
        return self._own.get(family, self._resolutions)

    def calls(self) -> list[Call]:
        """Estimators with their options, then peers."""
        return [*calls(self.estimators), *(Call(name, {}) for name in self.peers)]


def _read(path):
    import yaml

    try:
        return yaml.safe_load(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from None
    except yaml.YAMLError as error:
        raise InputError(f"{path} is no YAML: {str(error).splitlines()[0]}") from None


def _check_types(config, path):
    from jsonschema import Draft202012Validator

    schema = _read(SCHEMA)
    if not isinstance(config, dict):
        raise InputError(f"{path} has to be a mapping of keys to values")
    for key in config:
        check_name("key", key, schema["properties"], str(path))
    for key in schema["properties"]:
        if key not in config:
            raise InputError(f"{path}: key {key!r} is missing")
    for error in Draft202012Validator(schema).iter_errors(config):
        where = ": ".join([str(path), *(part for part in error.path if isinstance(part, str))])
        raise InputError(f"{where} has to be {error.schema['description']}, not {error.instance!r}")


def _names(key, value, catalogue):
    names = catalogue.names() if value == "all" else list(dict.fromkeys(value))
    for name in names:
        try:
            catalogue.path(name)  # quicker than to import it
        except InputError as error:
            raise InputError(f"{key}: {error}") from error
    return names
