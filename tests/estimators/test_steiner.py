"""H of (3.13) with each edge's own angle is that of Steiner's formula on convex polyhedra.

The volume within eps of a convex body is V + A eps + M eps^2 + 4/3 pi eps^3. For a polyhedron, M is
the volume of wedges along the edges, half the sum of |e| times the angle between the normals; for a
smooth body it is the integral of H.
"""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

import curvlib


def hull(points):
    """The convex hull of points (V, 3), all of them its vertices, as a mesh."""
    found = ConvexHull(points)
    faces, outward = found.simplices.astype(int), found.equations[:, :3]
    a, b, c = points[faces].swapaxes(0, 1)
    inward = (np.cross(b - a, c - a) * outward).sum(1) < 0
    faces[inward] = faces[inward, ::-1]
    assert set(faces.ravel()) == set(range(len(points)))
    return curvlib.Mesh(points, faces)


def total_mean_curvature(mesh, dihedral):
    """The sum of H_v A_v / 3 over the vertices, A_v the area of the ring."""
    a, b, c = mesh.vertices[mesh.faces].swapaxes(0, 1)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    cells = np.zeros(len(mesh.vertices))
    np.add.at(cells, mesh.faces, areas[:, None] / 3)
    return (curvlib.estimate(mesh, "gauss_bonnet", dihedral=dihedral).H * cells).sum()


@pytest.mark.parametrize("sides", [(1, 1, 1), (1, 2, 5)])
def test_of_a_box(sides):
    """V(eps) = abc + 2 (ab + bc + ca) eps + pi (a + b + c) eps^2 + 4/3 pi eps^3."""
    corners = np.indices((2, 2, 2)).reshape(3, -1).T * sides
    box = hull(corners)
    assert total_mean_curvature(box, "signed") == pytest.approx(np.pi * sum(sides))
    a, b, c = sides
    H = curvlib.estimate(box, "pooled_deficit", rings=3).H
    np.testing.assert_allclose(H * 2 * (a * b + b * c + c * a), np.pi * sum(sides))


@pytest.mark.parametrize("seed", range(4))
def test_of_a_random_convex_polyhedron(seed):
    """M is 2 pi times the mean width, the integral over the unit sphere of the greatest height
    max(p . u) in the direction u."""
    rng = np.random.default_rng(seed)
    points = rng.standard_normal((40, 3))
    points *= (1, 2, 3) / np.linalg.norm(points, axis=1)[:, None]
    mesh = hull(points + 7)

    z, weights = np.polynomial.legendre.leggauss(400)
    angles = np.arange(800) * 2 * np.pi / 800
    r = np.sqrt(1 - z * z)[:, None]
    heights = np.max(
        [x * r * np.cos(angles) + y * r * np.sin(angles) + h * z[:, None] for x, y, h in points],
        axis=0,
    )
    expected = weights @ heights.mean(1) * 2 * np.pi
    assert total_mean_curvature(mesh, "signed") == pytest.approx(expected, rel=1e-5)
    a, b, c = mesh.vertices[mesh.faces].swapaxes(0, 1)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    H = curvlib.estimate(mesh, "pooled_deficit", radius=10).H
    np.testing.assert_allclose(H * area, expected, rtol=1e-5)
    # The angle of the next edge, as (3.13) is printed, has no such meaning.
    assert total_mean_curvature(mesh, "as-printed") != pytest.approx(expected, rel=1e-3)
