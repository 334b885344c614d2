"""What --weld and --orient do to a mesh before an estimate."""


def mended(mesh, weld, orient):
    """The mesh welded and turned as asked; which of its vertices it keeps; counts by words."""
    import numpy as np

    import curvlib

    kept, counts = np.arange(len(mesh.vertices)), {}
    if orient:
        # A soup has edges once all points at one place are one; welding would leave apart what
        # does not agree.
        _, first, place = np.unique(mesh.vertices, axis=0, return_index=True, return_inverse=True)
        joined = curvlib.Mesh(mesh.vertices, first[place.reshape(-1)][mesh.faces], copy=False)
        _, turned = curvlib.orient(joined)
        faces = np.where(turned[:, None], mesh.faces[:, ::-1], mesh.faces)
        mesh = curvlib.Mesh(mesh.vertices, faces, normals=mesh.normals)
        counts["triangles turned over"] = int(turned.sum())
    if weld:
        welded, index = curvlib.weld(mesh)
        kept, new = np.unique(index, return_inverse=True)
        normals = None if welded.normals is None else welded.normals[kept]
        mesh = curvlib.Mesh(mesh.vertices[kept], new.reshape(-1)[mesh.faces], normals=normals)
        counts["vertices joined to others"] = len(index) - len(kept)
    return mesh, kept, counts
