"""How fast: this package and its peers, from arrays of vertices and faces to values.

`python -m curvlib.comparison.throughput METHOD THREADS MESH.npz` measures one of them in a
process of its own, so that its peak memory is its own, and prints a row as JSON.
"""

import functools
import itertools
import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from curvlib.catalogue import estimators
from curvlib.estimation import estimate
from curvlib.surfaces import load

REFERENCE = "libigl gaussian_curvature"
SECONDS, RUNS = 3.0, 9  # a method is run until it has had either, but twice at least


def torus(rows: int, kind: str, seed: int = 0):
    """Vertices (rows^2, 3) and faces of a torus with radii 2 and 1: kind "regular" from a grid
    in its angles, "irregular" from the Delaunay triangles of that grid's jittered points."""
    i, j = np.divmod(np.arange(rows * rows), rows)
    points = np.stack((i, j), -1).astype(float)
    if kind == "irregular":
        points += np.random.default_rng(seed).uniform(-0.45, 0.45, points.shape)
    angles = 2 * np.pi / rows * points
    around, ring = np.cos(angles), np.sin(angles)
    r = 2 + around[:, 1]
    vertices = np.stack((r * around[:, 0], r * ring[:, 0], ring[:, 1]), -1)
    return vertices, (_grid if kind == "regular" else _delaunay)(points, rows)


def _grid(points, rows):
    i, j = points.astype(int).T
    a, b, c, d = (
        (i + di) % rows * rows + (j + dj) % rows for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1))
    )
    return np.stack((a, b, c, a, c, d), -1).reshape(-1, 3)


def _delaunay(points, rows):
    from scipy.spatial import Delaunay

    # The period and a margin of its copies; of each triangle's copies the one inside is kept.
    cell = np.stack(np.meshgrid(*[np.arange(-3, rows + 3)] * 2, indexing="ij"), -1).reshape(-1, 2)
    index = cell % rows @ (rows, 1)
    copies = points[index] + cell - cell % rows
    triangles = Delaunay(copies).simplices
    centre = copies[triangles].mean(1)
    triangles = triangles[((centre >= 0) & (centre < rows)).all(1)]
    p, q = (copies[triangles[:, k]] - copies[triangles[:, 0]] for k in (1, 2))
    turned = p[:, 0] * q[:, 1] < p[:, 1] * q[:, 0]
    triangles[turned] = triangles[turned, ::-1]
    return index[triangles].astype(np.int64)


def _igl(function):
    import igl

    return lambda vertices, faces, threads: getattr(igl, function)(vertices, faces)


def _vtk():
    import pyvista

    def run(vertices, faces, threads):
        mesh = pyvista.PolyData.from_regular_faces(vertices, faces)
        return mesh.curvature("gaussian"), mesh.curvature("mean")

    return run


def _meshlab():
    import pymeshlab

    def run(vertices, faces, threads):
        meshes, values = pymeshlab.MeshSet(), []
        meshes.add_mesh(pymeshlab.Mesh(vertices, faces.astype(np.int32)))
        for kind in ("Gaussian Curvature", "Mean Curvature"):
            meshes.compute_scalar_by_discrete_curvature_per_vertex(curvaturetype=kind)
            values.append(meshes.current_mesh().vertex_scalar_array())
        return values

    return run


def _trimesh():
    import trimesh

    return lambda vertices, faces, threads: (
        trimesh.Trimesh(vertices, faces, process=False).vertex_defects
    )


def _ours(*names):
    return lambda vertices, faces, threads: estimate((vertices, faces), names, threads=threads)


# Each makes a function of (vertices, faces, threads), or raises ImportError.
PEERS = {
    REFERENCE: lambda: _igl("gaussian_curvature"),
    "libigl principal_curvature": lambda: _igl("principal_curvature"),
    "VTK K and H": _vtk,
    "MeshLab K and H": _meshlab,
    "trimesh vertex_defects": _trimesh,
}
# What no method can be faster than: six arctangents a vertex, or one copy of the input.
LIMITS = {
    "arctan2": lambda: lambda v, f, threads: [np.arctan2(v, v) for _ in range(2)],
    "copy": lambda: lambda v, f, threads: (v.copy(), f.copy()),
}


def methods():
    """Name -> maker of a function of (vertices, faces, threads), for all that is measured."""
    names = estimators.names()
    ours = {name: functools.partial(_ours, name) for name in names}
    return ours | {"all estimators": functools.partial(_ours, *names)} | PEERS | LIMITS


def measure(method: str, threads: int, vertices, faces) -> dict:
    """A row: `seconds` (median), `ratio` to the reference (median over runs that take turns with
    it; NaN where it is not installed), `bytes_per_vertex` of memory at the peak beyond the mesh
    itself, `note` where the method is not installed."""
    row = {"method": method, "threads": threads, "vertices": len(vertices)}
    try:
        run = methods()[method]()
    except ImportError as error:
        return row | {"note": f"not installed: {error}"}
    # What is loaded or compiled once is no matter of the mesh.
    run(*torus(8, "regular"), threads)
    before = _peak()
    run(vertices, faces, threads)
    peak = _peak() - before
    try:
        reference = PEERS[REFERENCE]()
    except ImportError:
        reference = None
    seconds, ratios, start = [], [], time.perf_counter()
    while len(seconds) < 2 or (len(seconds) < RUNS and time.perf_counter() - start < SECONDS):
        against = _time(reference, vertices, faces, 1) if reference else np.nan
        seconds.append(_time(run, vertices, faces, threads))
        ratios.append(seconds[-1] / against)
    row["seconds"] = statistics.median(seconds)
    row["vertices_per_second"] = len(vertices) / row["seconds"]
    row["ratio"] = statistics.median(ratios)
    return row | {"bytes_per_vertex": peak / len(vertices), "note": ""}


def rows(sizes, kinds=("regular", "irregular"), threads=(1, 2)):
    """Yield the rows of `measure` for all methods, `sizes` (square roots of the numbers of
    vertices), kinds of `torus` and numbers of threads; peers run on one thread."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "mesh.npz")

        def row(method, count):
            command = [sys.executable, "-m", __name__, method, str(count), str(path)]
            done = subprocess.run(command, stdout=subprocess.PIPE, check=True)
            return json.loads(done.stdout)

        def save(size, kind):
            np.savez(path, **dict(zip(("vertices", "faces"), torus(size, kind))))

        # Compiled once and kept: the compiler's own memory is no matter of the mesh.
        save(8, "regular")
        row("all estimators", 1)
        for size in sizes:
            for kind in kinds:
                save(size, kind)
                for method in methods():
                    for count in threads[: 1 if method in PEERS | LIMITS else None]:
                        yield {"mesh": kind} | row(method, count)


def exact_rows(name="teapot_spout", scattered=10_000, side=1000):
    """Yield rows for exact K and H at points of a surface, `scattered` or on a grid of `side`^2,
    and beside them for what others need to evaluate derivatives alone: `ratio` is the time for K
    and H over theirs, the median of runs that take turns."""
    from scipy.interpolate import BSpline, NdBSpline

    surface = load(name)
    m, rng = surface.model, np.random.default_rng(0)
    net = np.reshape(m.ctrlptsw, (m.ctrlpts_size_u, m.ctrlpts_size_v, 4))
    knots, degrees = (
        [np.array(k) for k in (m.knotvector_u, m.knotvector_v)],
        (m.degree_u, m.degree_v),
    )
    spline = NdBSpline(tuple(knots), net, degrees)
    bases = [BSpline(k, np.eye(size), d) for k, size, d in zip(knots, net.shape, degrees)]
    orders = list(itertools.product(range(3), repeat=2))

    def geomdl(u, v):
        return [m.derivatives(*at, order=2) for at in zip(u, v)]

    def scipy(u, v):
        return [spline(np.stack((u, v), -1), nu=order) for order in orders]

    def products(u, v):
        along_u, along_v = ([b(t.ravel(), nu=nu) for nu in range(3)] for b, t in zip(bases, (u, v)))
        return [
            np.einsum("ui,ijc,vj->uvc", along_u[i], net, along_v[j], optimize=True)
            for i, j in orders
        ]

    def uniform(count):
        return [low + (high - low) * rng.random(count) for low, high in surface.domain]

    grid = [t.reshape(shape) for t, shape in zip(uniform(side), ((-1, 1), (1, -1)))]
    for arrangement, points, others in (
        ("scattered", uniform(scattered), {"geomdl derivatives": geomdl}),
        ("scattered", uniform(side * side), {"SciPy, nine derivatives": scipy}),
        ("grid", grid, {"nine products of basis matrices": products}),
    ):
        count = np.broadcast(*points).size
        for method, run in ({"K and H": surface.curvature} | others).items():
            seconds, ratios = [], []
            run(*(t.ravel()[:9] for t in points))
            for _ in range(3):
                ours = _time(surface.curvature, *points)
                seconds.append(_time(run, *points))
                ratios.append(ours / seconds[-1])
            row = {"method": method, "arrangement": arrangement, "points": count}
            row["seconds"] = statistics.median(seconds)
            row["points_per_second"] = count / row["seconds"]
            yield row | {"ratio": statistics.median(ratios)}


def _time(run, *arguments):
    start = time.perf_counter()
    run(*arguments)
    return time.perf_counter() - start


def _peak():
    """Bytes of memory that this process has held at most; NaN where the system does not tell."""
    # Not getrusage: that maximum is inherited from the process that started this one.
    status = Path("/proc/self/status")
    lines = status.read_text().splitlines() if status.exists() else ()
    return sum(1024 * int(x.split()[1]) for x in lines if x.startswith("VmHWM")) or np.nan


if __name__ == "__main__":
    method, threads, path = sys.argv[1:]
    mesh = np.load(path)
    print(json.dumps(measure(method, int(threads), mesh["vertices"], mesh["faces"])))
