"""The first use on a machine: two processes compile."""

import os
import subprocess
import sys
from contextlib import contextmanager

# On an octahedron, what `adaptive_fit` takes last on exact meshes, and what takes longest.
COMPACT = """
import curvlib
curvlib.estimate(
    ([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]],
     [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]]),
    "compact_hermite",
)
"""


@contextmanager
def compiled_beside(names):
    """Where the default estimator, of no `names`, finds no code of `compact_hermite` kept, and a
    second processor is there, another process compiles that while this one compiles the rest. It
    ends with the context."""
    process = None
    if not names and (os.cpu_count() or 1) > 1:
        from curvlib.kit.compiled import is_kept
        from curvlib.meshes.coupling import sweep

        if not is_kept(sweep):
            silent = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.DEVNULL)
            process = subprocess.Popen([sys.executable, "-c", COMPACT], **silent)
    try:
        yield
    finally:
        if process:
            process.terminate()
            process.wait()
