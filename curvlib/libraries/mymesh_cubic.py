"""mymesh: cubics fitted to one ring."""

LABEL = "mymesh.curvature.CubicFit"
SOURCE = "https://bioinfo-mymesh.readthedocs.io"
REQUIRES = "mymesh"


def values(vertices, faces):
    """k1 and k2."""
    import mymesh

    mesh = mymesh.mesh(vertices, faces, verbose=False)
    k1, k2 = mymesh.curvature.CubicFit(
        mesh.NodeCoords, mesh.SurfConn, mesh.SurfNodeNeighbors, mesh.NodeNormals, jit=False
    )
    return {"k1": k1, "k2": k2}
