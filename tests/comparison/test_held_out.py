"""Surfaces that no constant was set on: their exact values, their meshes."""

import numpy as np
import pytest

from curvlib.comparison.held_out import CLOSED, KINDS, STRETCH, held_out
from curvlib.comparison.quantities import QUANTITIES, compared
from curvlib.estimation import estimate

CASES = [(surface, kind) for surface, kinds in KINDS.items() for kind in kinds]


@pytest.mark.parametrize(("surface", "kind"), CASES)
def test_exact_values_are_those_that_a_fit_converges_to(surface, kind):
    """A sign or a factor that is wrong would leave an error that no refinement takes away."""
    errors = []
    for n in (30, 60):
        mesh = held_out(surface, n, 1, kind)
        found = estimate((mesh.vertices, mesh.faces), "jet", degree=4, rings=2)
        inner, errors_of = ~mesh.boundary, []
        for name, (exact, estimated) in compared(mesh, found).items():
            error = QUANTITIES[name].distance(exact, estimated)[inner]
            errors_of.append(np.nanmedian(error))
        errors.append(errors_of)
    assert len(errors[0]) == 5
    assert (np.array(errors[1]) < np.array(errors[0]) / 4).all()


@pytest.mark.parametrize(("surface", "kind"), CASES)
def test_meshes(surface, kind):
    """Outward, closed or with one boundary, with about n^2 vertices; a seed is a mesh."""
    n = 24
    mesh = held_out(surface, n, 3, kind)
    assert abs(len(mesh.vertices) / n**2 - 1) < 0.05
    assert mesh.boundary.any() == (surface not in CLOSED)
    a, b, c = mesh.vertices[mesh.faces].swapaxes(0, 1)
    outward = (np.cross(b - a, c - a) * mesh.normals[mesh.faces[:, 0]]).sum(1)
    assert (outward > 0).mean() > 0.99
    edges = len(np.unique(np.sort(mesh.faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)), axis=0))
    assert len(mesh.vertices) - edges + len(mesh.faces) == {"ring": 0}.get(
        surface, 2 if surface in CLOSED else 1
    )
    again, other = held_out(surface, n, 3, kind), held_out(surface, n, 4, kind)
    assert (again.vertices == mesh.vertices).all()
    assert not np.array_equal(other.vertices, mesh.vertices)


def test_a_stretched_mesh():
    mesh = held_out("wave", 30, 3, "stretched")
    steps = np.abs(np.diff(mesh.vertices[mesh.faces][..., :2], axis=1)).mean((0, 1))
    assert STRETCH / 1.5 < steps[1] / steps[0] < 1.5 * STRETCH
