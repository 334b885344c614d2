"""Files for other programs: PLY, and the text format of the paper.

Nothing is compressed: the output of deflate depends on the machine's zlib.
"""

import numpy as np

from curvlib.meshes.mesh import Mesh
from curvlib.meshes.writing import write_ply as ply


def write_ply(path, mesh: Mesh, about: dict) -> None:
    """Write binary PLY in double precision: x y z, the normal, K, H2 = H^2, and K again as
    `quality`, the only scalar that MeshLab shows. `about`: comment lines of the header."""
    columns = {"x y z": mesh.vertices, "nx ny nz": mesh.normals}
    columns |= {"K": mesh.K, "H2": mesh.H2, "quality": mesh.K}
    ply(path, columns, mesh.faces, {}, _lines(about))


def write_text(path, mesh: Mesh, about: dict) -> None:
    """Write a line `x y z K H^2` per vertex with 17 digits, enough for exact doubles.

    `about`: comment lines before them, which start with #.
    """
    header = "\n".join([*_lines(about), "x y z K H^2"])
    rows = np.column_stack((mesh.vertices, mesh.K, mesh.H2))
    np.savetxt(path, rows, fmt="%.17g", header=header, encoding="utf-8")


def _lines(about):
    """One line per item, line breaks in it replaced by spaces."""
    return [" ".join(f"{key}: {value}".split()) for key, value in about.items()]
