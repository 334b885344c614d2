"""LaPy: smoothed normal-cycle tensors."""

LABEL = "lapy.TriaMesh.curvature"
SOURCE = "https://deep-mi.org/LaPy/dev/api/generated/lapy.TriaMesh.html"
REQUIRES = "lapy"
DOCUMENTED = {
    "order of k1 and k2": "c_max: maximal curvature values",
}
REMEDIES = {
    "scaling": (
        "multiply k1, k2 and H by the mean edge times the number of edges "
        "at the vertex over twice its cell's area, K by the square of it"
    ),
    "sign": "negate H, k1 and k2; then k1 is the smaller one: swap them",
}


def values(vertices, faces):
    """All four, with LaPy's default of three steps of smoothing."""
    import lapy

    _, _, smaller, larger, H, K, _ = lapy.TriaMesh(vertices, faces).curvature()
    return {"K": K, "H": H, "k1": larger, "k2": smaller}
