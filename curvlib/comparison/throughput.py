"""Throughput of this package and its peers, from arrays of vertices and faces to values.

`python -m curvlib.comparison.throughput METHOD THREADS MESH.npz` measures one method and prints a
row as JSON: each has a process, and so a peak memory, of its own.
"""

import functools
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from curvlib.catalogue import estimators, peers
from curvlib.estimation import estimate
from curvlib.meshes.torus import torus

from .calls import calls
from .turns import in_turn

REFERENCE = "libigl gaussian_curvature"
SECONDS, RUNS = 3.0, 9  # a method is run until one of these is reached, at least twice
LONGEST = 60.0  # seconds of a run; a mesh on which it would take longer is left out


def _peer(name):
    """The library's call alone, without the conversion of what it returns."""
    returned = peers.module(name).returned
    returned(*torus(8, "regular"))  # ImportError where it is not installed
    return lambda vertices, faces, threads: returned(vertices, faces)


def _ours(call):
    def run(vertices, faces, threads):
        return estimate((vertices, faces), call.estimator, threads, **call.options)

    return run


# Each value makes a function of (vertices, faces, threads), or raises ImportError.
PEERS = {
    REFERENCE: lambda: _peer("libigl_defects"),
    "libigl principal_curvature": lambda: _peer("libigl_principal"),
    "VTK K and H": lambda: _peer("vtk_curvatures"),
    "MeshLab K and H": lambda: _peer("meshlab_discrete"),
    "trimesh vertex_defects": lambda: _peer("trimesh_defects"),
}
# Upper bounds on throughput: six arctangents a vertex, or one copy of the input.
LIMITS = {
    "arctan2": lambda: lambda v, f, threads: [np.arctan2(v, v) for _ in range(2)],
    "copy": lambda: lambda v, f, threads: (v.copy(), f.copy()),
}


def methods():
    """Name -> maker of a function of (vertices, faces, threads), for every method measured: the
    `calls` of estimators, PEERS and LIMITS."""
    return _calls() | PEERS | LIMITS


def _calls():
    return {str(call): functools.partial(_ours, call) for call in calls(estimators.names())}


def measure(method: str, threads: int, vertices, faces) -> dict:
    """A row: `seconds` (median); `ratio` to the reference (median of alternating runs; NaN if it is
    not installed); `bytes_per_vertex` of peak memory beyond the mesh; `note` if the method is not
    installed."""
    row = {"method": method, "threads": threads, "vertices": len(vertices)}
    try:
        run = methods()[method]()
    except ImportError as error:
        return row | {"note": f"not installed: {error}"}
    # A first run on a small mesh keeps imports and compilation out of time and memory.
    run(*torus(8, "regular"), threads)
    before = _peak()
    run(vertices, faces, threads)
    peak = _peak() - before
    try:
        reference = PEERS[REFERENCE]()
    except ImportError:
        reference = None
    row["seconds"], row["ratio"] = in_turn(
        functools.partial(run, vertices, faces, threads),
        reference and functools.partial(reference, vertices, faces, 1),
        time.perf_counter,
        RUNS,
        SECONDS,
        least=2,
    )
    row["vertices_per_second"] = len(vertices) / row["seconds"]
    return row | {"bytes_per_vertex": peak / len(vertices), "note": ""}


def rows(sizes, kinds=("regular", "irregular"), threads=(1, 2)):
    """Yield the rows of `measure` for all methods, `sizes` (square roots of the numbers of
    vertices) ascending, kinds of `torus` and numbers of threads. Peers run on one thread, and so do
    smaller sizes than the largest. A method that would take longer than LONGEST, by its time on the
    next smaller mesh, has a row with a `note` instead."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "mesh.npz")

        def row(method, count):
            command = [sys.executable, "-m", __name__, method, str(count), str(path)]
            done = subprocess.run(command, stdout=subprocess.PIPE, check=True)
            return json.loads(done.stdout)

        def save(size, kind):
            np.savez(path, **dict(zip(("vertices", "faces"), torus(size, kind))))

        # Compile once before any measurement: the compiler's memory would hide a smaller peak.
        for make in _calls().values():
            make()(*torus(8, "regular"), 1)
        slow = {}  # (method, kind) -> seconds a vertex
        for size in sizes:
            for kind in kinds:
                save(size, kind)
                for method in methods():
                    expected = size * size * slow.get((method, kind), 0)
                    if expected > LONGEST:
                        left_out = {"method": method, "threads": 1, "vertices": size * size}
                        yield {"mesh": kind, **left_out, "note": f"not run: {expected:.0f} s"}
                        continue
                    alone = method in PEERS | LIMITS or size < max(sizes)
                    for count in threads[: 1 if alone else None]:
                        measured = row(method, count)
                        slow[method, kind] = measured.get("seconds", 0) / measured["vertices"]
                        yield {"mesh": kind} | measured


def _peak():
    """Peak resident memory of this process in bytes; NaN where /proc does not exist."""
    # getrusage would return the maximum inherited from the parent process.
    status = Path("/proc/self/status")
    lines = status.read_text(encoding="utf-8").splitlines() if status.exists() else ()
    return sum(1024 * int(x.split()[1]) for x in lines if x.startswith("VmHWM")) or np.nan


if __name__ == "__main__":
    method, threads, path = sys.argv[1:]
    mesh = np.load(path)
    print(json.dumps(measure(method, int(threads), mesh["vertices"], mesh["faces"])))
