"""A mesh with all its exact values in one file: HDF5 in the VTKHDF layout, written and read.

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
