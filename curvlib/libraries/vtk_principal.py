"""VTK, by pyvista: from its own mean and Gaussian curvature."""

LABEL = "pyvista .curvature('maximum'), ('minimum')"
SOURCE = "https://docs.pyvista.org/api/core/_autosummary/pyvista.PolyDataFilters.curvature"
REQUIRES = "vtk pyvista"
DOCUMENTED = {
    "scaling": "Return the point-wise curvature of a mesh.",
    "order of k1 and k2": (
        'For "maximum" and "minimum", points where the discrete Gaussian '
        "and mean curvatures are inconsistent are assigned the mean "
        "curvature."
    ),
}


def values(vertices, faces):
    """k1 and k2 of vtkCurvatures."""
    import pyvista

    mesh = pyvista.PolyData.from_regular_faces(vertices, faces)
    return {"k1": mesh.curvature("maximum"), "k2": mesh.curvature("minimum")}
