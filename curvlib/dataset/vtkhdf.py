"""A mesh with all its exact values in one file: HDF5 in the VTKHDF layout, written and read."""

from curvlib.files import write_hdf5
from curvlib.meshes.mesh import FIELDS, Mesh
from curvlib.meshes.writing import put_vtkhdf


def write_vtkhdf(path, mesh: Mesh, about: dict) -> None:
    """Write HDF5 in the VTKHDF layout, PolyData, which VTK, ParaView and pyvista open directly.

    Point data are the mesh's exact values, H2 = H^2, and `smooth`, `pole`, `boundary` as 0 or 1.
    `about`: attributes of the file's root.
    """
    arrays = {name: getattr(mesh, name) for name in FIELDS}
    arrays |= {"H2": mesh.H2, "boundary": mesh.boundary}
    with write_hdf5(path) as file:
        file.attrs.update(about)
        put_vtkhdf(file, mesh.vertices, mesh.faces, arrays, {})


def read_vtkhdf(file) -> Mesh:
    """The mesh in an open h5py file of `write_vtkhdf`; KeyError where a part is missing."""
    root = file["VTKHDF"]
    fields = {name: root["PointData"][name][()] for name in FIELDS}
    fields |= {name: fields[name].astype(bool) for name in ("smooth", "pole")}
    faces = root["Polygons/Connectivity"][()].reshape(-1, 3)
    return Mesh(root["Points"][()], faces, **fields)
