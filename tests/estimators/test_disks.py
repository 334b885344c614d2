"""Estimators of disks: threads, balls, fields, values not returned, loops that are kept."""

import os
import subprocess
import sys
from typing import Annotated, Literal

import numpy as np
import pytest

import curvlib
from curvlib.kit.options import Length
from curvlib.meshes.torus import torus


@pytest.mark.parametrize("options", [{}, {"rings": 3}, {"radius": "2 edges"}, {"radius": 0.5}])
def test_any_number_of_threads_gives_the_same_bytes(monkeypatch, options):
    mesh = curvlib.tessellate(curvlib.surface("revolution"), 16, "random", seed=7)
    for name in ("quadric", "jet", smoothed):
        chosen = options if name is not smoothed else {}
        monkeypatch.setattr("curvlib.meshes.loops.BLOCK", 2048)
        alone = curvlib.estimate(mesh, name, **chosen)
        monkeypatch.setattr("curvlib.meshes.loops.BLOCK", 7)
        for threads in (1, 2, 5):
            again = curvlib.estimate(mesh, [name, "taubin"][:1], threads=threads, **chosen)[name]
            for quantity in ("K", "H", "k1", "d1"):
                a, b = getattr(again, quantity), getattr(alone, quantity)
                np.testing.assert_array_equal(a, b)


def test_a_ball_of_any_size():
    """All of a mesh in each disk: more than memory is made for at first."""
    vertices, faces = torus(40, "irregular")
    found = curvlib.estimate((vertices, faces), whole, radius=100.0)
    assert (found.K == len(vertices) - 1).all()
    np.testing.assert_allclose(
        found.H, [np.linalg.norm(vertices - v, axis=1).max() for v in vertices]
    )


def whole(disk, radius: Length = None):
    return float(disk.count), disk.radius


def field(disk):
    """Normals, by the triangles of one ring."""
    return disk.normal


def smoothed(disk, field, rings: Literal[2] = 2):
    """The mean of the normals over two rings: its length, and its angle to that of the vertex."""
    x = y = z = 0.0
    for i in range(1 + disk.count):
        x, y, z = x + field[0, i], y + field[1, i], z + field[2, i]
    x, y, z = x / (1 + disk.count), y / (1 + disk.count), z / (1 + disk.count)
    own = field[0, 0] * x + field[1, 0] * y + field[2, 0] * z
    return own, np.sqrt(x * x + y * y + z * z)


def test_a_field_is_gathered_at_the_vertex_and_its_neighbours():
    mesh = curvlib.tessellate(curvlib.surface("revolution"), 12, "random", seed=1)
    found = curvlib.estimate(mesh, smoothed)
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    facets = np.cross(b - a, c - a)
    normals = np.zeros_like(mesh.vertices)
    for k in range(3):
        np.add.at(normals, mesh.faces[:, k], facets)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    near = np.eye(len(normals), dtype=bool)
    for k in range(3):
        near[mesh.faces[:, k], mesh.faces[:, k - 1]] = near[
            mesh.faces[:, k - 1], mesh.faces[:, k]
        ] = True
    two = (near.astype(int) @ near.astype(int)) > 0
    mean = (two @ normals) / two.sum(1)[:, None]
    np.testing.assert_allclose(found.K, (mean * normals).sum(1), rtol=1e-12)
    np.testing.assert_allclose(found.H, np.linalg.norm(mean, axis=1), rtol=1e-12)


RINGS = """
import numpy as np
from curvlib.kit.frame import unit_normal

LABEL = "Rings"


def field(ring, normal="area"):
    return unit_normal(ring, "area")


def estimate(ring, field):
    assert field.shape == (3, *(np.array(ring.areas.shape) + (1, 0)))
    return (field[:, 0] * field[:, 1:].mean(1)).sum(0), None
"""


def test_a_field_takes_a_part_of_a_length():
    """In the unit of the mesh, in mean edges, and on a mesh whose lengths are scaled."""

    def within(disk, radius: Annotated[Length, 0.5] = "3 edges"):
        return disk.radius, radius

    def estimate(disk, within, radius: Length = "3 edges"):
        return disk.radius / within[0, 0], radius / within[1, 0]

    estimate.__globals__["within"] = within
    points, faces = torus(40, "regular")
    for scale in (1.0, 1e150):
        mesh = curvlib.Mesh(points * scale, faces)
        for options in ({}, {"radius": 4 * mesh.mean_edge}):
            found = curvlib.estimate(mesh, estimate, **options)
            # Values are turned to the unit of the mesh.
            np.testing.assert_allclose(found.H / mesh.unit, 2)
            assert 1.4 < np.median(found.K) / mesh.unit**2 < 3


def test_a_field_of_rings(tmp_path):
    """NaN next to vertices without a ring, which have no normal."""
    path = tmp_path / "rings.py"
    path.write_text(RINGS)
    mesh = curvlib.tessellate(curvlib.surface("revolution"), 12)
    found = curvlib.estimate(mesh, str(path)).K
    beside = np.zeros(len(found), bool)
    beside[mesh.faces[mesh.boundary[mesh.faces].any(1)]] = True
    np.testing.assert_array_equal(np.isnan(found), beside)
    assert (found[~beside] < 1).all()
    assert (found[~beside] > 0.5).all()


def test_no_field():
    source = {"__builtins__": __builtins__}
    exec("def estimate(disk, field):\n    return 0.0, 0.0", source)
    with pytest.raises(curvlib.InputError, match="no function of this name beside it"):
        curvlib.estimate(torus(8, "regular"), source["estimate"])


def test_what_a_disk_does_not_return_is_nan():
    found = curvlib.estimate(torus(8, "regular"), lambda disk: (None, disk.radius))
    assert np.isnan(found.K).all()
    assert (found.H > 0).all()
    assert found.d1 is None
    with pytest.raises(curvlib.InputError, match="has to return K and H, or"):
        curvlib.estimate(torus(8, "regular"), lambda disk: (0.0, 0.0, 0.0))


KEPT = """
import curvlib, sys
from curvlib.meshes.torus import torus
from curvlib.meshes.around import DISK
from curvlib.meshes.loops import _estimates

name = sys.argv[1]
print(curvlib.estimate(torus(8, "regular"), name).H[0])
function = curvlib.signatures.resolved(name)[1]
print(sum(_estimates(function, True, *DISK).stats.cache_hits.values()))
"""

MINE = """
from curvlib.kit.compiled import compiled

LABEL = "Mine"


@compiled
def estimate(disk):
    return None, {value}
"""


def test_loops_are_kept_for_the_next_process(tmp_path):
    """And compiled anew where the estimator's file has changed, whatever its size and time."""
    path = tmp_path / "mine.py"

    def run(value):
        path.write_text(MINE.format(value=value))
        command = [sys.executable, "-c", KEPT, str(path)]
        done = subprocess.run(
            command,
            env=os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)},
            capture_output=True,
            check=True,
        )
        return done.stdout.decode().split()

    assert run(1.5) == ["1.5", "0"]
    assert run(1.5) == ["1.5", "1"]
    assert run(2.5) == ["2.5", "0"]
    assert run(1.5) == ["1.5", "1"]
