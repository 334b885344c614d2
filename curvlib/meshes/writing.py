"""Meshes with values written to files, whole or not at all: the counterpart of `reading`."""

from pathlib import Path

import numpy as np

from curvlib.errors import InputError
from curvlib.files import whole_file, write_hdf5

# The first version of the VTKHDF layout that has PolyData.
VTKHDF_VERSION = (2, 0)


def write(path, mesh, named: dict, per: str = "vertex") -> None:
    """Write a mesh with values per vertex or face in the format that the suffix names.

    Parameters
    ----------
    path : str or path
        .vtp, .vtk (VTK's XML and legacy formats), .vtkhdf; .ply, K also as `quality`, which MeshLab
        shows; .csv, .parquet, a row for each vertex or face; .gii, each number an array of float32;
        .curv, H as FreeSurfer's overlay of float32. The latter two are of vertices.
    mesh : Mesh
    named : dict
        Column -> values (n,) or (n, 3).
    per : {"vertex", "face"}

    Raises
    ------
    InputError
        The suffix is not known, its library is not installed, the format has no place for such
        values, or the system refuses the file.
    """
    check_output(path, per)
    try:
        with whole_file(path) as part:
            WRITERS[Path(path).suffix.lower()](part, mesh, named, per)
    except ImportError as error:
        raise InputError(
            f"{str(path)!r}: writing {Path(path).suffix} needs {error.name}: install it"
        ) from None


def check_output(path, per: str = "vertex") -> None:
    """Raise InputError where `write` knows no format for a path, or it is a folder."""
    path = Path(path)
    if path.is_dir():
        raise InputError(f"{str(path)!r} is a folder; name a file in it, such as values.vtp")
    suffix = path.suffix.lower()
    if suffix not in WRITERS:
        known = ", ".join(WRITERS)
        raise InputError(f"{str(path)!r}: cannot tell the format by its suffix; known: {known}")
    if per == "face" and suffix in OF_VERTICES:
        raise InputError(f"{str(path)!r}: {suffix} has no place for values of triangles; use .vtp")


def polydata(mesh, named: dict, per: str = "vertex"):
    """A pyvista.PolyData of a mesh with its own arrays; columns are point or cell data."""
    import pyvista

    data = pyvista.PolyData.from_regular_faces(np.array(mesh.vertices), np.array(mesh.faces))
    place = data.point_data if per == "vertex" else data.cell_data
    for name, values in named.items():
        place[name] = np.array(values)
    return data


def write_ply(path, columns: dict, faces, of_faces: dict, comments=()) -> None:
    """Write binary PLY of doubles: `columns` of vertices, `of_faces` of triangles, both by names in
    one text ("x y z") -> values (n, k), or (n,) for one name; `comments`: lines of the header."""
    own = " ".join(of_faces).split()
    face = np.dtype([("count", "u1"), ("vertices", "<i4", 3), *((name, "<f8") for name in own)])
    rows = np.empty(len(faces), dtype=face)
    rows["count"], rows["vertices"] = 3, faces
    if own:
        for name, values in zip(own, np.column_stack(list(of_faces.values())).T):
            rows[name] = values
    table = np.column_stack(list(columns.values())).astype("<f8")
    header = [
        "ply",
        "format binary_little_endian 1.0",
        *(f"comment {line}" for line in comments),
        f"element vertex {len(table)}",
        *(f"property double {name}" for name in " ".join(columns).split()),
        f"element face {len(faces)}",
        "property list uchar int vertex_indices",
        *(f"property double {name}" for name in own),
        "end_header",
    ]
    with open(path, "wb") as file:
        file.write("\n".join(header).encode() + b"\n")
        file.write(table.tobytes())
        file.write(rows.tobytes())


def put_vtkhdf(file, vertices, faces, point_data: dict, cell_data: dict) -> None:
    """Put a PolyData into an open h5py file in the VTKHDF layout, uncompressed: the output of
    deflate depends on the machine's zlib."""
    root = file.create_group("VTKHDF")
    root.attrs["Version"] = VTKHDF_VERSION
    root.attrs["Type"] = np.bytes_("PolyData")
    root["Points"] = vertices
    root["NumberOfPoints"] = [len(vertices)]
    for kind in ("Vertices", "Lines", "Strips", "Polygons"):
        cells, its = root.create_group(kind), faces if kind == "Polygons" else faces[:0]
        cells["Connectivity"] = its.ravel().astype(np.int64)
        cells["Offsets"] = 3 * np.arange(len(its) + 1, dtype=np.int64)
        cells["NumberOfCells"] = [len(its)]
        cells["NumberOfConnectivityIds"] = [its.size]
    for group, arrays in (("PointData", point_data), ("CellData", cell_data)):
        if arrays:
            data = root.create_group(group)
            for name, array in arrays.items():
                data[name] = array.astype(np.uint8) if array.dtype == bool else array


def _pyvista(path, mesh, named, per):
    polydata(mesh, named, per).save(path)


def _vtkhdf(path, mesh, named, per):
    points, cells = (named, {}) if per == "vertex" else ({}, named)
    with write_hdf5(path) as file:
        put_vtkhdf(file, mesh.vertices, mesh.faces, points, cells)


def _ply(path, mesh, named, per):
    own = {
        name if values.ndim == 1 else f"{name}_x {name}_y {name}_z": values
        for name, values in named.items()
    }
    shown = next((values for values in named.values() if values.ndim == 1), None)
    if shown is not None:
        own["quality"] = shown
    columns = {"x y z": mesh.vertices} | (own if per == "vertex" else {})
    write_ply(path, columns, mesh.faces, {} if per == "vertex" else own)


def _table(mesh, named, per):
    """Column -> numbers, the place of the vertex or the triangle's centre first."""
    from curvlib.columns import scalars

    place = mesh.vertices if per == "vertex" else mesh.vertices[mesh.faces].mean(1)
    return dict(zip("xyz", place.T)) | scalars(named)


def _csv(path, mesh, named, per):
    table = _table(mesh, named, per)
    rows = np.column_stack(list(table.values()))
    # 17 digits are enough for exact doubles.
    np.savetxt(
        path,
        rows,
        fmt="%.17g",
        delimiter=",",
        header=",".join(table),
        comments="",
        encoding="utf-8",
    )


def _parquet(path, mesh, named, per):
    import pyarrow
    import pyarrow.parquet

    table = {name: np.ascontiguousarray(x) for name, x in _table(mesh, named, per).items()}
    pyarrow.parquet.write_table(pyarrow.table(table), path)


def _gifti(path, mesh, named, per):
    import nibabel

    from curvlib.columns import scalars

    arrays = [
        nibabel.gifti.GiftiDataArray(
            values.astype(np.float32), intent="NIFTI_INTENT_SHAPE", meta={"Name": name}
        )
        for name, values in scalars(named).items()
    ]
    nibabel.save(nibabel.gifti.GiftiImage(darrays=arrays), path)


def _freesurfer(path, mesh, named, per):
    import nibabel

    if "H" not in named:
        raise InputError("a .curv file holds H of one estimator, which is not there; use .gii")
    nibabel.freesurfer.write_morph_data(path, named["H"].astype(np.float32), len(mesh.faces))


WRITERS = {
    ".vtp": _pyvista,
    ".vtk": _pyvista,
    ".vtkhdf": _vtkhdf,
    ".ply": _ply,
    ".csv": _csv,
    ".parquet": _parquet,
    ".gii": _gifti,
    ".curv": _freesurfer,
}
OF_VERTICES = (".gii", ".curv")
