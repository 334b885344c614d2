"""VTK, by pyvista: angle defects over cells."""

LABEL = "pyvista .curvature('gaussian')"
SOURCE = "https://docs.pyvista.org/api/core/_autosummary/pyvista.PolyDataFilters.curvature"
REQUIRES = "vtk pyvista"
DOCUMENTED = {
    "scaling": "Return the point-wise curvature of a mesh.",
}


def values(vertices, faces):
    """K of vtkCurvatures."""
    import pyvista

    mesh = pyvista.PolyData.from_regular_faces(vertices, faces)
    return {"K": mesh.curvature("gaussian")}
