"""What compiled code owes: a cache that is never stale, files from elsewhere, plain Python."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import curvlib

PACKAGE = Path(curvlib.__file__).parent

STRANGER = """
from curvlib.kit.compiled import compiled
from curvlib.kit.ring import total
from curvlib.kit.vectors import norm

LABEL, STYLE = "x", {}
FACTOR = 1


@compiled
def estimate(ring):
    return FACTOR * total(ring.areas), None
"""

RUN = """
import sys, curvlib
mesh = curvlib.tessellate(curvlib.surface("sphere"), 4)
from curvlib.catalogue import estimators
function = estimators.module(sys.argv[1]).estimate
print(curvlib.__file__, curvlib.estimate(mesh, sys.argv[1]).K.sum())
stats = getattr(function, "stats", None)
print(sum(stats.cache_hits.values()) if stats else "none")
"""


@pytest.fixture
def run(tmp_path):
    """A process's estimate by an estimator: their sum, and how often it came from the cache."""

    def run(estimator, package=PACKAGE, **environment):
        given = os.environ | {
            "XDG_CACHE_HOME": str(tmp_path / "cache"),
            "PYTHONPATH": str(package.parent),
        }
        command = [sys.executable, "-c", RUN, str(estimator)]
        env = given | environment
        done = subprocess.run(
            command, env=env, cwd=tmp_path, capture_output=True, text=True, check=True
        )
        (file, value), (hits,) = (line.split() for line in done.stdout.splitlines())
        assert Path(file).parent == package
        return float(value), hits

    return run


def test_a_file_from_elsewhere_is_kept_compiled_until_it_changes(run, tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(STRANGER)
    value, hits = run(path)
    assert hits == "0"
    assert run(path) == (value, "1")
    path.write_text(STRANGER.replace("FACTOR = 1", "FACTOR = 3"))
    assert run(path) == (pytest.approx(3 * value), "0")


def test_a_change_in_what_it_calls_is_noticed(run, tmp_path):
    """Numba itself would look at the estimator's own file alone."""
    copy = shutil.copytree(PACKAGE, tmp_path / "copy/curvlib")
    path = tmp_path / "mine.py"
    path.write_text(STRANGER)
    value, _ = run(path, copy)
    ring = copy / "kit/ring.py"
    source = ring.read_text()
    ring.write_text(source.replace("out[k] += x[i, k]", "out[k] += 2 * x[i, k]"))
    assert ring.read_text() != source
    assert run(path, copy) == (pytest.approx(2 * value), "0")


def test_without_a_place_to_keep_it(run, tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(STRANGER)
    (tmp_path / "file").write_text("")
    expected, _ = run(path)
    assert run(path, XDG_CACHE_HOME=str(tmp_path / "file")) == (expected, "0")


@pytest.mark.parametrize("name", curvlib.estimators())
def test_compiled_code_is_python_too(run, name):
    mesh = curvlib.tessellate(curvlib.surface("sphere"), 4)
    expected = pytest.approx(curvlib.estimate(mesh, name).K.sum(), rel=1e-9)
    assert run(name, NUMBA_DISABLE_JIT="1") == (expected, "none")
