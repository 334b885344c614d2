"""mymesh: cubics fitted to one ring and its normals."""

from curvlib.peers._turned import over_used, six

LABEL = "mymesh, cubic"
SOURCE = "https://bioinfo-mymesh.readthedocs.io"
REQUIRES = "mymesh"
RETURNS = "pointwise"
SIGN = "ours"
BOUNDARY = "estimated"
ORDER = "as named"
# The fit adds squares of lengths, of heights, to those of slopes.
DEPENDS = "unit"


def returned(vertices, faces):
    """Principal curvatures and directions of the fit of Goldfeather and Interrante (2004)."""
    import mymesh

    mesh = mymesh.mesh(vertices, faces, verbose=False)
    # Compiled, it takes as long again as 10,000 vertices, in each process.
    return mymesh.curvature.CubicFit(
        mesh.NodeCoords,
        mesh.SurfConn,
        mesh.SurfNodeNeighbors,
        mesh.NodeNormals,
        jit=False,
        return_directions=True,
    )


def estimate(mesh):
    """All six, from the vertices and normals of one ring."""
    return six(mesh, *over_used(returned, mesh))
