"""VTK, by pyvista: vtkCurvatures."""

from curvlib.peers._turned import over_used, where_closed

LABEL = "VTK"
SOURCE = "https://vtk.org/doc/nightly/html/classvtkCurvatures.html"
REQUIRES = "pyvista"
RETURNS = "pointwise"
SIGN = "ours"
BOUNDARY = "as closed"
ORDER = None


def returned(vertices, faces):
    """K as the angle defect over the barycentric cell; H as half the mean, over the edges, of three
    times their length and angle over the area of the two triangles."""
    import pyvista

    mesh = pyvista.PolyData.from_regular_faces(vertices, faces)
    return mesh.curvature("gaussian"), mesh.curvature("mean")


def estimate(mesh):
    """K and H; NaN where the triangles do not close to one ring."""
    return where_closed(mesh, *over_used(returned, mesh))
