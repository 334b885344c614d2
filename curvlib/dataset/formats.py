"""One mesh in a file: VTKHDF, PLY, and the text that the paper describes.

Nothing is compressed: the output of deflate depends on the machine's zlib.
"""

import numpy as np

from curvlib.files import write_hdf5
from curvlib.meshes.mesh import FIELDS, Mesh

# The first version of the layout that has PolyData.
VTKHDF_VERSION = (2, 0)


def write_vtkhdf(path, mesh: Mesh, about: dict) -> None:
    """Write HDF5 in the VTKHDF layout, PolyData, which VTK, ParaView and pyvista open directly.

    Point data are the mesh's exact values, H2 = H^2, and `smooth`, `pole`, `boundary` as 0 or 1.
    `about`: attributes of the file's root.
    """
    with write_hdf5(path) as file:
        file.attrs.update(about)
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = VTKHDF_VERSION
        root.attrs["Type"] = np.bytes_("PolyData")
        root["Points"] = mesh.vertices
        root["NumberOfPoints"] = [len(mesh.vertices)]
        for kind in ("Vertices", "Lines", "Strips", "Polygons"):
            faces = mesh.faces if kind == "Polygons" else mesh.faces[:0]
            cells = root.create_group(kind)
            cells["Connectivity"] = faces.ravel().astype(np.int64)
            cells["Offsets"] = 3 * np.arange(len(faces) + 1, dtype=np.int64)
            cells["NumberOfCells"] = [len(faces)]
            cells["NumberOfConnectivityIds"] = [faces.size]
        data = root.create_group("PointData")
        arrays = {name: getattr(mesh, name) for name in FIELDS}
        arrays |= {"H2": mesh.H2, "boundary": mesh.boundary}
        for name, array in arrays.items():
            data[name] = array.astype(np.uint8) if array.dtype == bool else array


def read_vtkhdf(file) -> Mesh:
    """The mesh in an open h5py file of `write_vtkhdf`; KeyError where a part is missing."""
    root = file["VTKHDF"]
    fields = {name: root["PointData"][name][()] for name in FIELDS}
    fields |= {name: fields[name].astype(bool) for name in ("smooth", "pole")}
    faces = root["Polygons/Connectivity"][()].reshape(-1, 3)
    return Mesh(root["Points"][()], faces, **fields)


def write_ply(path, mesh: Mesh, about: dict) -> None:
    """Write binary PLY in double precision: x y z, the normal, K, H2 = H^2, and K again as
    `quality`, the only scalar that MeshLab shows. `about`: comment lines of the header."""
    columns = {"x y z": mesh.vertices, "nx ny nz": mesh.normals}
    columns |= {"K": mesh.K, "H2": mesh.H2, "quality": mesh.K}
    names = " ".join(columns).split()
    face = np.dtype([("count", "u1"), ("vertices", "<i4", 3)])
    faces = np.empty(len(mesh.faces), dtype=face)
    faces["count"], faces["vertices"] = 3, mesh.faces
    header = [
        "ply",
        "format binary_little_endian 1.0",
        *(f"comment {line}" for line in _lines(about)),
        f"element vertex {len(mesh.vertices)}",
        *(f"property double {name}" for name in names),
        f"element face {len(mesh.faces)}",
        "property list uchar int vertex_indices",
        "end_header",
    ]
    with open(path, "wb") as file:
        file.write("\n".join(header).encode() + b"\n")
        file.write(np.column_stack(list(columns.values())).astype("<f8").tobytes())
        file.write(faces.tobytes())


def write_text(path, mesh: Mesh, about: dict) -> None:
    """Write a line `x y z K H^2` per vertex with 17 digits, which give the same doubles back.

    `about`: lines before them, which start with #.
    """
    header = "\n".join([*_lines(about), "x y z K H^2"])
    rows = np.column_stack((mesh.vertices, mesh.K, mesh.H2))
    np.savetxt(path, rows, fmt="%.17g", header=header, encoding="utf-8")


def _lines(about):
    """One line per item, whatever line breaks its text has."""
    return [" ".join(f"{key}: {value}".split()) for key, value in about.items()]
