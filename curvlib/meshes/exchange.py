"""Meshes from files and the objects of other libraries, with their points in their order."""

import warnings
from os import PathLike

import numpy as np

from curvlib.errors import InputError, MeshWarning

from .mesh import Mesh
from .reading import read_arrays

# Cell types of VTK without area, and its triangle.
NO_AREA, TRIANGLE = {0, 1, 2, 3, 4}, 5
# Bits of the cell data vtkGhostType: duplicate cell, hidden cell.
GHOST = 1 | 32
# Where float32 coordinates are coarser than this part of an edge, rounding decides curvature.
COARSE = 0.01


def as_mesh(obj) -> Mesh:
    """A Mesh from (vertices, faces) or from another library's object; a Mesh is returned as it is.

    The object is a path, a mesh of trimesh or meshio, a PolyData or UnstructuredGrid, or one that
    pyvista wraps into these. Points keep their order; lines, points and ghost cells are left out;
    point normals become the mesh's. A new Mesh shares the arrays.

    Raises InputError for anything but a triangle mesh; the message says how to convert it.
    """
    if isinstance(obj, Mesh):
        return obj
    vertices, faces, normals = _arrays(obj)
    try:
        mesh = Mesh(vertices, faces, copy=False, normals=normals)
    except InputError as error:
        if isinstance(obj, (str, PathLike)):
            raise InputError(f"{str(obj)!r}: {error}") from None
        raise
    _warn_of_coarse_coordinates(np.asarray(vertices), mesh)
    return mesh


def read(path) -> Mesh:
    """Read a triangle mesh from a file.

    Parameters
    ----------
    path : str or path
        PLY, OBJ, STL, OFF; glTF, GLB, 3MF (read by trimesh), VTK, VTP, VTU, VTKHDF, MSH (by
        pyvista), GIFTI or FreeSurfer (by nibabel).

    Returns
    -------
    Mesh
        Vertices in the order of the file, three for each triangle of STL; faces of more corners
        are divided into triangles, lines and points left out; `normals` where the file has some.

    Raises
    ------
    InputError
        There is no such file, its suffix is not known, its reader is not installed, it cannot be
        read, or there are no triangles in it.

    Examples
    --------
    >>> import tempfile, pathlib
    >>> off = pathlib.Path(tempfile.mkdtemp(), "triangle.off")
    >>> _ = off.write_text("OFF 3 1 0\\n0 0 0\\n1 0 0\\n0 1 0\\n3 0 1 2\\n")
    >>> read(off)
    <Mesh of 3 vertices, 1 faces>
    """
    return as_mesh(path if isinstance(path, PathLike) else str(path))


def _arrays(obj):
    """Vertices, faces and normals (or None) of an object."""
    name = type(obj).__name__
    if isinstance(obj, (str, PathLike)):
        return read_arrays(obj)
    if isinstance(obj, (tuple, list)):
        if len(obj) != 2:
            raise InputError(f"a mesh is a pair (vertices, faces), not {len(obj)} things")
        return *obj, None
    if hasattr(obj, "geometry") and hasattr(obj, "to_geometry"):
        return _arrays(obj.to_mesh())  # a Scene of trimesh
    if hasattr(obj, "cells_dict") and hasattr(obj, "points") and hasattr(obj, "cell_sets"):
        return _of_cells(name, obj.points, obj.cells_dict, "triangle", ("vertex", "line"))
    if hasattr(obj, "vertices") and hasattr(obj, "faces"):
        return obj.vertices, obj.faces, None
    try:
        import pyvista
    except ImportError:
        raise InputError(
            f"a mesh is a curvlib.Mesh or a pair (vertices, faces); for {name} install pyvista"
        ) from None
    try:
        data = pyvista.wrap(obj)
    except (NotImplementedError, TypeError, ValueError) as error:
        raise InputError(f"cannot wrap {name} as a mesh: {error}") from None
    if data is None:
        raise InputError("a mesh is a curvlib.Mesh or a pair (vertices, faces), not None")
    if isinstance(data, pyvista.PolyData):
        return _of_polydata(data)
    if isinstance(data, pyvista.UnstructuredGrid) and "vtkGhostType" not in data.cell_data:
        return _of_cells(name, data.points, data.cells_dict, TRIANGLE, NO_AREA)
    raise InputError(
        f"{type(data).__name__} is no triangle mesh; pass its .extract_surface().triangulate(), "
        "whose point data vtkOriginalPointIds tell which point of yours each one is"
    )


def _of_cells(name, points, cells, triangle, without_area):
    """As `_arrays`, from cells by type: triangles; cells without area are left out."""
    others = {str(kind) for kind in cells if kind != triangle and kind not in without_area}
    if triangle not in cells or others:
        found = f"cells of type {', '.join(sorted(others))}" if others else "no triangles"
        raise InputError(
            f"{name} has {found}; pass its .extract_surface().triangulate() by pyvista, whose "
            "point data vtkOriginalPointIds tell which point of yours each one is (their order "
            "changes)"
        )
    return points, cells[triangle], None


def _of_polydata(data):
    """As `_arrays`, from a PolyData."""
    faces = np.asarray(data.faces)
    if data.n_strips or len(faces) % 4 or (faces[::4] != 3).any():
        raise InputError(
            "PolyData is no triangle mesh, some faces have more corners; pass its .triangulate()"
        )
    faces = faces.reshape(-1, 4)[:, 1:]
    ghosts = data.cell_data.get("vtkGhostType")
    if ghosts is not None:
        # Cell data is ordered: points, lines, faces.
        first = data.n_verts + data.n_lines
        faces = faces[(np.asarray(ghosts)[first:] & GHOST) == 0]
    normals = data.point_data.active_normals
    return np.asarray(data.points), faces, None if normals is None else np.asarray(normals)


def _warn_of_coarse_coordinates(given, mesh):
    """Warn of float32 coordinates far from the origin, which keep few digits of an edge."""
    if given.dtype != np.float32 or not len(mesh.faces):
        return
    some = mesh.vertices[mesh.faces[:: 1 + len(mesh.faces) // 1000]]
    edge = np.sqrt(((some - np.roll(some, 1, axis=1)) ** 2).sum(-1).mean())
    step = float(np.spacing(np.float32(np.nanmax(np.abs(mesh.vertices)))))
    if step > COARSE * edge:
        warnings.warn(
            f"vertices: float32 coordinates of this size are multiples of {step:.2g}, but edges "
            f"are {edge:.2g} long; curvature is left to chance: subtract an offset before "
            "rounding, or keep float64",
            MeshWarning,
            stacklevel=5,
        )
