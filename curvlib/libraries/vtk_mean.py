"""VTK, by pyvista: angles at edges over areas."""

LABEL = "pyvista .curvature('mean')"
SOURCE = "https://docs.pyvista.org/api/core/_autosummary/pyvista.PolyDataFilters.curvature"
REQUIRES = "vtk pyvista"
DOCUMENTED = {
    "scaling": "Return the point-wise curvature of a mesh.",
}


def values(vertices, faces):
    """H of vtkCurvatures."""
    import pyvista

    mesh = pyvista.PolyData.from_regular_faces(vertices, faces)
    return {"H": mesh.curvature("mean")}
