"""The plan of the benchmark: what a config may say, and what it makes."""

from pathlib import Path

import pytest
import yaml

import curvlib
from curvlib.benchmark.plan import Plan
from curvlib.catalogue import families, peers
from curvlib.errors import InputError

CONFIG = Path(curvlib.__file__).parents[1] / "config"


@pytest.fixture
def quick(tmp_path):
    """A function that writes the quick config with changes, and reads it as a Plan."""
    config = yaml.safe_load((CONFIG / "benchmark-quick.yaml").read_text(encoding="utf-8"))

    def plan(**changes):
        path = tmp_path / "plan.yaml"
        path.write_text(yaml.safe_dump(config | changes), encoding="utf-8")
        return Plan(path)

    plan.noise = config["noise"]
    return plan


def test_the_benchmark_is_about_everything_there_is():
    plan = Plan(CONFIG / "benchmark.yaml")
    assert plan.estimators == curvlib.estimators()
    assert plan.peers == peers.names()
    assert plan.families == families.names()
    assert len(plan.noise["levels"]) == 7
    assert plan.parts[-1].startswith("noise-")
    assert plan.resolutions("voxels") != plan.resolutions("jittered")
    assert {call.estimator for call in plan.calls()} == {*plan.estimators, *plan.peers}


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"estimators": ["jett"]}, "estimators: .*did you mean 'jet'"),
        ({"families": ["voxel"]}, "families: .*did you mean 'voxels'"),
        ({"own_resolutions": {"fans": [8]}}, "own_resolutions.*did you mean 'fan'"),
        ({"resolutions": [4]}, "resolutions has to be an integer of at least 8, not 4"),
        ({"seed": "one"}, "seed has to be an integer from 0 on, not 'one'"),
        ({"sed": 1}, "did you mean 'seed'"),
    ],
)
def test_what_is_wrong_is_told_in_one_line(quick, changes, told):
    with pytest.raises(InputError, match=told) as error:
        quick(**changes)
    assert "\n" not in str(error.value)


def test_noise_is_of_a_family_on_its_surfaces(quick):
    with pytest.raises(InputError, match=r"noise: surfaces.*did you mean 'torus'"):
        quick(noise=quick.noise | {"surfaces": ["tours"]})
    with pytest.raises(InputError, match="did you mean 'white'"):
        quick(noise=quick.noise | {"kinds": ["withe"]})


def test_a_file_that_is_missing_or_no_yaml(tmp_path):
    with pytest.raises(InputError, match="No such file"):
        Plan(tmp_path / "none.yaml")
    (tmp_path / "plan.yaml").write_text("a: [", encoding="utf-8")
    with pytest.raises(InputError, match="is no YAML"):
        Plan(tmp_path / "plan.yaml")
