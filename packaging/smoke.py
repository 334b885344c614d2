"""What an installed curvlib has to do with its core dependencies alone: run in an empty folder."""

import json
import math
import subprocess
import sys
from importlib import metadata, resources
from pathlib import Path

import numpy as np

import curvlib


def sphere():
    """A sphere's mesh with exact values."""
    return curvlib.tessellate(curvlib.surface("sphere"), 16)


def ply_of(mesh, path):
    """Write a mesh as the plainest PLY there is."""
    lines = [
        "ply",
        "format ascii 1.0",
        f"element vertex {len(mesh.vertices)}",
        *(f"property float {axis}" for axis in "xyz"),
        f"element face {len(mesh.faces)}",
        "property list uchar int vertex_indices",
        "end_header",
        *(" ".join(map(str, row)) for row in mesh.vertices),
        *("3 " + " ".join(map(str, row)) for row in mesh.faces),
    ]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def command(*arguments):
    """What the console script prints."""
    script = Path(sys.executable).with_name("curvlib")
    done = subprocess.run([script, *arguments], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def main():
    """Run everything; an AssertionError names what fails."""
    installed = Path(curvlib.__file__).parent
    assert "site-packages" in installed.parts, installed
    assert metadata.version("curvlib") == curvlib.__version__
    assert resources.files("curvlib").joinpath("py.typed").is_file()
    mesh = sphere()
    assert abs(mesh.H - 1).max() < 1e-12
    # Angles of pi at each vertex, and a third of three triangles of area 2 sqrt(3).
    tetrahedron = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    faces = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]
    K = curvlib.estimate((tetrahedron, faces), "gauss_bonnet").K
    assert abs(K - math.pi / (2 * math.sqrt(3))).max() < 1e-12
    # Every estimator of the package compiles here.
    for name, result in curvlib.estimate(mesh, curvlib.estimators()).items():
        assert np.isfinite(result.H).any() or np.isfinite(result.K).any(), name
    ply_of(mesh, Path("sphere.ply"))
    assert "triangles" in command("info", "sphere.ply")
    command("estimate", "sphere.ply", "-e", "jet", "--set", "degree=4", "-o", "sphere.csv")
    table = np.genfromtxt("sphere.csv", delimiter=",", names=True)
    assert len(table) == len(mesh.vertices)
    assert abs(np.nanmedian(table["H"]) - 1) < 0.01
    told = json.loads(command("estimate", "sphere.ply", "--json"))
    assert math.isclose(
        told["estimators"]["adaptive_fit"]["quantiles"]["K"]["0.5"], 1, rel_tol=0.01
    )
    command("mesh", "teapot_spout", "-n", "8", "-o", "spout.ply")
    spout = curvlib.tessellate(curvlib.surface("teapot_spout"), 8)
    assert abs(curvlib.read("spout.ply").vertices - spout.vertices).max() < 1e-12
    assert list(json.loads(command("list", "--json"))["estimators"]) == curvlib.estimators()


if __name__ == "__main__":
    main()
