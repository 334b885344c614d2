"""mymesh: quadrics fitted to one ring."""

LABEL = "mymesh.curvature.QuadFit"
SOURCE = "https://bioinfo-mymesh.readthedocs.io"
REQUIRES = "mymesh"


def values(vertices, faces):
    """k1 and k2."""
    import mymesh

    mesh = mymesh.mesh(vertices, faces, verbose=False)
    k1, k2 = mymesh.curvature.QuadFit(
        mesh.NodeCoords, mesh.SurfConn, mesh.SurfNodeNeighbors, mesh.NodeNormals
    )
    return {"k1": k1, "k2": k2}
