"""mouette: angle defects."""

LABEL = "mouette.attributes.angle_defects"
SOURCE = "https://pypi.org/project/mouette/"
REQUIRES = "mouette"
DOCUMENTED = {
    "scaling": (
        "Computes the angle defect at each vertex, defined as 2*pi minus "
        "the sum of angles around the vertex."
    ),
}


def values(vertices, faces):
    """K, with mouette's default at the boundary."""
    import mouette

    mesh = mouette.mesh.from_arrays(vertices, F=faces)
    return {"K": mouette.attributes.angle_defects(mesh, persistent=False).as_array(len(vertices))}
