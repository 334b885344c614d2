"""What the first use on a machine compiles in a second process."""

import os
import subprocess
import sys

PROGRAM = """
import time
from curvlib.commands import first_use
from curvlib.kit.compiled import is_kept
from curvlib.meshes.coupling import sweep

first_use.os.cpu_count = lambda: 2
assert not is_kept(sweep)
with first_use.compiled_beside([]):
    end = time.monotonic() + 300
    while not is_kept(sweep) and time.monotonic() < end:
        time.sleep(0.1)
assert is_kept(sweep)


def refused(*arguments, **options):
    raise AssertionError


first_use.subprocess.Popen = refused
with first_use.compiled_beside([]):
    pass
with first_use.compiled_beside(["quadric"]):
    print("done")
"""


def test_another_process_compiles_where_nothing_is_kept(tmp_path):
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}
    command = [sys.executable, "-c", PROGRAM]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=400)
    assert (done.stdout, done.returncode) == ("done\n", 0), done.stderr


def test_one_processor_compiles_alone(monkeypatch):
    from curvlib.commands import first_use

    monkeypatch.setattr(first_use.os, "cpu_count", lambda: 1)
    monkeypatch.setattr(first_use.subprocess, "Popen", None)
    with first_use.compiled_beside([]):
        pass
