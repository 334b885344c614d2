"""What compiled code owes: a cache that is never stale, files from elsewhere, plain Python."""

import functools
import os
import resource
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

import curvlib
from curvlib.kit.compiled import compiled
from curvlib.meshes.torus import torus

PACKAGE = Path(curvlib.__file__).parent
PLACES = "NUMBA_CACHE_DIR", "XDG_CACHE_HOME", "HOME"


@compiled
def shifted(x, by):
    return x + by


@compiled
def shifted_twice(x):
    return shifted(x, 1) + shifted(x, 2)


def test_a_function_is_compiled_once_for_all_constants():
    assert shifted_twice(1.5) == 6
    if hasattr(shifted, "signatures"):
        # None where the caller comes compiled from an earlier run.
        assert len(shifted.get_overload.__self__.overloads) <= 1


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
from curvlib.meshes.torus import torus
mesh = torus(6, "irregular")
from curvlib.catalogue import estimators
function = estimators.module(sys.argv[1]).estimate
K = curvlib.estimate(mesh, sys.argv[1]).K
print(curvlib.__file__, K[K == K].sum())
stats = getattr(function, "stats", None)
print(sum(stats.cache_hits.values()) if stats else "none")
"""


@pytest.fixture
def run(tmp_path):
    """A process's estimate by an estimator: their sum, and how often it came from the cache."""

    def run(estimator, package=PACKAGE, limit=None, **environment):
        given = os.environ | {
            "NUMBA_CACHE_DIR": str(tmp_path / "cache"),
            "PYTHONPATH": str(package.parent),
        }
        command = [sys.executable, "-c", RUN, str(estimator)]
        env = given | environment
        done = subprocess.run(
            command, env=env, cwd=tmp_path, capture_output=True, text=True, preexec_fn=limit
        )
        assert done.returncode == 0, done.stderr
        (file, value), (hits,) = (line.split() for line in done.stdout.splitlines())
        assert Path(file).parent == package
        run.warnings = done.stderr.count("Warning:")
        return float(value), hits

    return run


@pytest.fixture
def mine(tmp_path):
    path = tmp_path / "mine.py"
    path.write_text(STRANGER)
    return path


def test_a_file_from_elsewhere_is_kept_compiled_until_it_changes(run, mine):
    value, hits = run(mine)
    assert hits == "0"
    assert run(mine) == (value, "1")
    mine.write_text(STRANGER.replace("FACTOR = 1", "FACTOR = 3"))
    assert run(mine) == (pytest.approx(3 * value), "0")


def test_a_change_in_what_it_calls_is_noticed(run, mine, tmp_path):
    """Numba itself would look at the estimator's own file alone."""
    copy = shutil.copytree(PACKAGE, tmp_path / "copy/curvlib")
    value, _ = run(mine, copy)
    ring = copy / "kit/ring.py"
    source = ring.read_text()
    ring.write_text(source.replace("out[k] += x[i, k]", "out[k] += 2 * x[i, k]"))
    assert ring.read_text() != source
    assert run(mine, copy) == (pytest.approx(2 * value), "0")


@pytest.mark.parametrize(
    ("environment", "folder"),
    [
        ({"HOME": "/a"}, "/a/.cache/curvlib"),
        ({"HOME": "/a", "XDG_CACHE_HOME": "/b"}, "/b/curvlib"),
        ({"HOME": "/a", "XDG_CACHE_HOME": "/b", "NUMBA_CACHE_DIR": "/c"}, "/c/curvlib"),
        ({"HOME": "/a", "XDG_CACHE_HOME": "", "NUMBA_CACHE_DIR": ""}, "/a/.cache/curvlib"),
    ],
)
def test_where_it_is_kept(environment, folder):
    bare = {name: value for name, value in os.environ.items() if name not in PLACES}
    code = "from curvlib.kit.compiled import cache_folder; print(cache_folder())"
    command = [sys.executable, "-c", code]
    given = bare | {"PYTHONPATH": str(PACKAGE.parent)} | environment
    assert subprocess.check_output(command, env=given, text=True) == f"{folder}\n"


@pytest.mark.parametrize(
    "environment",
    [
        {"NUMBA_CACHE_DIR": "file"},
        {"NUMBA_CACHE_DIR": "", "XDG_CACHE_HOME": "file"},
        {"NUMBA_CACHE_DIR": "", "XDG_CACHE_HOME": "", "HOME": "/proc"},
    ],
)
def test_without_a_place_to_keep_it(run, mine, tmp_path, environment):
    """A file in the place of the folder; a home folder that nobody can write to."""
    (tmp_path / "file").write_text("")
    expected, _ = run(mine)
    assert run.warnings == 0
    assert run(mine, **environment) == (expected, "0")
    assert run.warnings == 1


def test_without_room_to_keep_it(run, mine, tmp_path):
    """Writing ends with OSError after so many bytes, as on a full disk."""
    expected, _ = run(mine)
    for room in (0, 5000):
        environment = {"NUMBA_CACHE_DIR": str(tmp_path / f"room-{room}")}
        limit = functools.partial(resource.setrlimit, resource.RLIMIT_FSIZE, (room, room))
        assert run(mine, limit=limit, **environment) == (expected, "0")
        assert run.warnings == 1
        assert run(mine, **environment) == (expected, "0")


@pytest.mark.parametrize(("kinds", "part"), [(("nbc",), 0), (("nbi",), 0), (("nbc", "nbi"), 0.9)])
def test_a_file_cut_short_is_compiled_again_and_mended(run, mine, tmp_path, kinds, part):
    expected = run(mine)[0]
    files = [path for kind in kinds for path in (tmp_path / "cache").rglob(f"*.{kind}")]
    assert len(files) >= 5 * len(kinds)
    for path in files:
        whole = path.read_bytes()
        path.write_bytes(whole[: int(part * len(whole))])
    assert run(mine) == (expected, "0")
    assert run(mine) == (expected, "1")


SIGNATURES = """
import sys
import numpy as np
from curvlib.kit.compiled import compiled

@compiled
def twice(x):
    return x[0] + x[0]

print(twice(np.ones(3)), twice(np.ones(3, dtype=int)))
"""


def test_code_for_other_arguments_under_that_name(tmp_path):
    """As two processes that find the same free name leave it."""
    path = tmp_path / "signatures.py"
    path.write_text(SIGNATURES)
    environment = os.environ | {
        "NUMBA_CACHE_DIR": str(tmp_path),
        "PYTHONPATH": str(PACKAGE.parent),
    }

    def printed():
        done = subprocess.run([sys.executable, path], env=environment, capture_output=True)
        return done.stdout.decode().strip()

    assert printed() == "2.0 2"
    one, other = (next(tmp_path.rglob(f"signatures.twice-*.{k}.nbc")) for k in (1, 2))
    other.write_bytes(one.read_bytes())
    assert printed() == "2.0 2"


def test_two_processes_at_a_time(run, mine):
    with ThreadPoolExecutor() as pool:
        (a, _), (b, _) = pool.map(run, [mine, mine])
    assert a == b
    assert run(mine) == (a, "1")


def test_an_import_writes_nothing(tmp_path):
    environment = os.environ | {
        "NUMBA_CACHE_DIR": str(tmp_path / "cache"),
        "PYTHONPATH": str(PACKAGE.parent),
    }
    code = (
        "import curvlib.kit.ring, curvlib.estimation, curvlib.meshes.corners, curvlib.nurbs.exact"
    )
    subprocess.run([sys.executable, "-c", code], env=environment, check=True)
    assert list(tmp_path.iterdir()) == []


def test_code_of_states_that_none_uses_is_removed(run, mine, tmp_path):
    base = tmp_path / "cache/curvlib"
    old, recent, other = base / "0123456789abcdef", base / "fedcba9876543210", base / "mine"
    day = 24 * 3600
    for folder, age in ((old, 31 * day), (recent, 29 * day), (other, 31 * day)):
        (folder / "estimators").mkdir(parents=True)
        os.utime(folder, (time.time() - age,) * 2)
    run(mine)
    assert not old.exists()
    assert {recent, other} < set(base.iterdir())
    (used,) = set(base.iterdir()) - {recent, other}
    os.utime(used, (0, 0))
    run(mine)
    assert used.stat().st_mtime > time.time() - day


def test_the_state_of_the_package_is_that_of_files_that_import_compiled(tmp_path):
    """They are found by these words; a file of compiled code must hold them."""
    copy = shutil.copytree(PACKAGE, tmp_path / "curvlib")
    code = "from curvlib.kit.compiled import _folder; print(_folder())"

    def folder():
        environment = os.environ | {"PYTHONPATH": str(tmp_path)}
        return subprocess.check_output([sys.executable, "-c", code], env=environment, cwd=tmp_path)

    for path in copy.rglob("*.py"):
        source = path.read_text(encoding="utf-8")
        decorated = "\n@compiled\n" in source or "\n@kernel\n" in source
        assert decorated <= ("compiled import" in source), path
    before = folder()
    for name, changes in (
        ("figures/style.py", False),
        ("kit/vectors.py", True),
        ("kit/polynomial.py", True),  # imports `kernel` alone
        ("kit/lanes.py", True),  # code that Numba inlines
    ):
        path = copy / name
        source = path.read_text()
        path.write_text(source + "\nX = 1\n")
        assert (folder() != before) == changes, name
        path.write_text(source)


@pytest.mark.parametrize("name", curvlib.estimators())
def test_compiled_code_is_python_too(run, name):
    K = curvlib.estimate(torus(6, "irregular"), name).K
    expected = pytest.approx(K[K == K].sum(), rel=1e-9)
    assert run(name, NUMBA_DISABLE_JIT="1") == (expected, "none")
