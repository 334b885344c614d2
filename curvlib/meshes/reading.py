"""Meshes from files, by the readers of other libraries."""

import warnings
from difflib import get_close_matches
from pathlib import Path

import numpy as np

from curvlib.errors import InputError

# Reader by suffix. FreeSurfer's surfaces have names such as lh.pial.
SUFFIXES = {
    **dict.fromkeys((".ply", ".obj", ".stl", ".off", ".glb", ".gltf", ".3mf"), "trimesh"),
    **dict.fromkeys((".vtp", ".vtk", ".vtu", ".vtkhdf", ".msh"), "pyvista"),
    ".gii": "gifti",
    **dict.fromkeys(
        (".pial", ".white", ".orig", ".inflated", ".smoothwm", ".sphere"), "freesurfer"
    ),
}
NEEDS = {"gifti": "nibabel", "freesurfer": "nibabel"}


def read_arrays(path):
    """Vertices, faces and normals (or None) of a file, as `curvlib.read` says."""
    path = Path(path).expanduser()
    if not path.is_file():
        near = get_close_matches(path.name, _siblings(path), n=1)
        hint = f"; did you mean {str(path.with_name(near[0]))!r}?" if near else ""
        raise InputError(f"{str(path)!r}: no such file{hint}")
    reader = SUFFIXES.get(path.suffix.lower())
    if reader is None:
        known = ", ".join(sorted(SUFFIXES))
        raise InputError(f"{str(path)!r}: cannot tell its format by its suffix; known: {known}")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            vertices, faces, normals = READERS[reader](path)
    except ImportError as error:
        needed = NEEDS.get(reader, reader)
        raise InputError(
            f"{str(path)!r}: reading {path.suffix} needs {error.name or needed}: "
            "install curvlib[files]"
        ) from None
    except (Exception, SystemExit) as error:  # meshio ends the process
        words = " ".join(str(error).split()) or type(error).__name__
        raise InputError(f"{str(path)!r}: {reader} cannot read it: {words}") from None
    if not len(faces):
        raise InputError(f"{str(path)!r}: there are no triangles in it")
    return np.asarray(vertices), np.asarray(faces), normals


def _siblings(path):
    return [p.name for p in path.parent.iterdir()] if path.parent.is_dir() else []


def _trimesh(path):
    import trimesh

    # As it stands: by default points are merged and normals made.
    mesh = trimesh.load_mesh(path, process=False)
    raw = mesh.metadata.get("_ply_raw", {}).get("vertex", {}).get("data")
    normals = None
    if raw is not None and {"nx", "ny", "nz"} <= set(raw.dtype.names or ()):
        normals = np.column_stack([raw[name].reshape(-1) for name in ("nx", "ny", "nz")])
    elif "vertex_normals" in mesh._cache:
        normals = mesh._cache["vertex_normals"]
    same = normals is not None and len(normals) == len(mesh.vertices)
    return mesh.vertices, mesh.faces, np.array(normals, float) if same else None


def _pyvista(path):
    import pyvista

    data = pyvista.read(path)
    if isinstance(data, pyvista.MultiBlock):
        data = data.combine()
    if not isinstance(data, pyvista.PolyData):
        count = data.n_points
        surface = data.extract_surface(algorithm="dataset_surface", pass_pointid=True)
        own = surface.point_data["vtkOriginalPointIds"]
        faces = np.asarray(surface.triangulate().regular_faces)
        return data.points[:count], own[faces], None
    normals = data.point_data.active_normals
    faces = data.triangulate().regular_faces
    return data.points, faces, None if normals is None else np.array(normals, float)


def _gifti(path):
    import nibabel

    image = nibabel.load(path)
    return *(image.agg_data(name) for name in ("pointset", "triangle")), None


def _freesurfer(path):
    import nibabel

    return *nibabel.freesurfer.read_geometry(path)[:2], None


READERS = {
    "trimesh": _trimesh,
    "pyvista": _pyvista,
    "gifti": _gifti,
    "freesurfer": _freesurfer,
}
