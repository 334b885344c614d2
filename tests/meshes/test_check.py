"""What is wrong with a mesh, on meshes made wrong."""

import numpy as np
import pytest
import pyvista

import curvlib
from curvlib.meshes.check import check
from curvlib.meshes.torus import torus


def faults(vertices, faces):
    return {f.name: f for f in check(curvlib.Mesh(vertices, faces)).faults}


def test_a_torus():
    vertices, faces = torus(12, "irregular")
    report = check(curvlib.Mesh(vertices, faces))
    assert (report.vertices, report.triangles, report.components) == (144, 288, 1)
    assert (report.closed, report.genus, report.boundaries) == (True, 1, 0)
    assert report.faults == []
    assert not report.staircase
    ends = np.unique(np.sort(np.vstack((faces[:, :2], faces[:, 1:], faces[:, [2, 0]])), 1), axis=0)
    lengths = np.linalg.norm(vertices[ends[:, 0]] - vertices[ends[:, 1]], axis=1)
    np.testing.assert_allclose(report.edges, np.quantile(lengths, np.arange(5) / 4))
    mesh = pyvista.PolyData.from_regular_faces(vertices, faces)
    assert report.volume == pytest.approx(mesh.volume)
    assert report.area == pytest.approx(mesh.area)
    moved = check(curvlib.Mesh(vertices + 1e7, faces))
    assert moved.volume == pytest.approx(mesh.volume, rel=1e-6)


@pytest.mark.filterwarnings("error::RuntimeWarning")
@pytest.mark.parametrize("scale", [2.0**-600, 2.0**-900, 2.0**900])
def test_a_torus_of_any_size(scale):
    """The same faults and shape where squares of lengths are no float64."""
    vertices, faces = torus(8, "irregular")
    one = check(curvlib.Mesh(vertices, faces[:, ::-1]))
    other = check(curvlib.Mesh(vertices * scale, faces[:, ::-1]))
    assert [(f.name, f.count) for f in one.faults] == [(f.name, f.count) for f in other.faults]
    assert [f.name for f in other.faults] == ["closed components that face inward"]
    assert (other.genus, other.boundaries, other.noise) == (1, 0, one.noise)
    np.testing.assert_array_equal(other.edges, one.edges * scale)
    np.testing.assert_array_equal(other.low, one.low * scale)


def test_components_holes_and_the_unused():
    ball = pyvista.Icosphere(radius=1, nsub=2)
    vertices, faces = torus(8, "regular")
    tube = pyvista.Cylinder(resolution=20, capping=False).triangulate().clean()
    sizes = np.cumsum([0, len(vertices), ball.n_points, tube.n_points])
    points = np.vstack((vertices, ball.points, tube.points, [[7, 7, 7]]))
    every = np.vstack((faces, ball.regular_faces + sizes[1], tube.regular_faces + sizes[2]))
    report = check(curvlib.Mesh(points, every))
    assert report.components == 3
    assert report.boundaries == 2
    assert not report.closed
    assert report.genus is None
    assert np.isnan(report.volume)
    assert (report.high < 7).all()
    assert [(f.name, f.where.tolist()) for f in report.faults] == [
        ("vertices without a triangle", [len(points) - 1])
    ]
    closed = check(curvlib.Mesh(points[: sizes[2]], every[: len(faces) + ball.n_cells]))
    assert (closed.components, closed.genus) == (2, 1)


def test_each_fault_and_where():
    vertices, faces = torus(12, "irregular")
    soup = vertices[faces].reshape(-1, 3), np.arange(faces.size).reshape(-1, 3)
    (found,) = faults(*soup).values()
    assert found.name == "vertices that stand where another does"
    assert found.count == faces.size - len(vertices)

    a, b, _ = faces[7]
    fin = faults(np.vstack((vertices, [[9, 9, 9]])), np.vstack((faces, [[a, b, len(vertices)]])))
    many = fin["edges of more than two triangles"]
    assert many.where.tolist() == [sorted((a, b))]
    assert set(fin) == {"edges of more than two triangles"}

    turned = faces.copy()
    turned[20] = turned[20, ::-1]
    against = faults(vertices, turned)
    assert set(against) == {"edges whose two triangles face opposite sides"}
    sides = {tuple(sorted(p)) for p in zip(turned[20], np.roll(turned[20], 1))}
    where = against["edges whose two triangles face opposite sides"].where
    assert {tuple(e) for e in where} == sides

    inward = faults(vertices, faces[:, ::-1])
    assert inward["closed components that face inward"].where.tolist() == [0]

    other = np.where(faces == 5, 5, faces + len(vertices))
    touching = faults(
        np.vstack((vertices, -vertices + 2 * vertices[5])), np.vstack((faces, other[:, ::-1]))
    )
    assert touching["vertices where surfaces touch in a point"].where.tolist() == [5]

    again = faults(vertices, np.vstack((faces, faces[[3]], [[4, 4, 9]])))
    assert again["triangles that are there again"].where.tolist() == [len(faces)]
    assert again["triangles that name a vertex twice"].where.tolist() == [len(faces) + 1]
    assert len(again) == 2

    placed = np.vstack((vertices, np.full((1, 3), np.nan)))
    placed[30] = np.inf
    nowhere = faults(placed, faces)
    (name,) = nowhere
    assert name == "vertices whose position is not finite"
    assert nowhere[name].where.tolist() == [30, len(vertices)]

    flat = vertices.copy()
    a, b, c = faces[100]
    flat[a] = 0.25 * flat[b] + 0.75 * flat[c]
    assert 100 in faults(flat, faces)["triangles without area"].where
    thin = vertices.copy()
    thin[a] = 0.995 * flat[a] + 0.005 * vertices[a]
    assert 100 in faults(thin, faces)["triangles with an angle below 1 degree"].where
    assert "triangles without area" not in faults(thin, faces)


def test_without_triangles_or_vertices():
    report = check(curvlib.Mesh(np.zeros((2, 3)), np.zeros((0, 3), int)))
    assert (report.triangles, report.components, report.closed) == (0, 0, False)
    assert [f.name for f in report.faults] == ["vertices without a triangle"]
    assert check(curvlib.Mesh(np.zeros((0, 3)), np.zeros((0, 3), int))).faults == []
