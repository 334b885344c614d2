"""pymadcad: quadrics fitted over two rings."""

LABEL = "madcad.scheme.mesh_curvatures"
SOURCE = "https://pymadcad.readthedocs.io"
REQUIRES = "pymadcad"
INSTALL = "needs an older pillow than the rest: pip install pymadcad, in an environment of its own"


def values(vertices, faces):
    """k1 and k2: its two values at a vertex, in its order; NaN where it has none."""
    import madcad
    import numpy as np
    from madcad.scheme import mesh_curvatures

    points = [madcad.vec3(*point) for point in vertices]
    mesh = madcad.Mesh(points, [tuple(map(int, face)) for face in faces])
    found = [pair[0] if pair else (np.nan, np.nan) for pair in mesh_curvatures(mesh)]
    k1, k2 = np.array(found).T
    return {"k1": k1, "k2": k2}
