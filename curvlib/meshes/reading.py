"""Meshes from files: of simple formats by readers here, of others by those of other libraries."""

import io
import logging
import os
import subprocess
import sys
import warnings
from contextlib import contextmanager
from difflib import get_close_matches
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from curvlib.errors import InputError

from .plain import read_obj, read_off, read_stl
from .ply import read_ply

# Reader by suffix. FreeSurfer's surfaces have names such as lh.pial.
SUFFIXES = {
    **{".ply": "curvlib", ".obj": "curvlib", ".stl": "curvlib", ".off": "curvlib"},
    **dict.fromkeys((".glb", ".gltf", ".3mf"), "trimesh"),
    **dict.fromkeys((".vtp", ".vtu"), "pyvista"),
    **dict.fromkeys((".vtk", ".vtkhdf", ".msh"), "pyvista, apart"),
    ".gii": "gifti",
    **dict.fromkeys(
        (".pial", ".white", ".orig", ".inflated", ".smoothwm", ".sphere"), "freesurfer"
    ),
}
OURS = {".ply": read_ply, ".obj": read_obj, ".stl": read_stl, ".off": read_off}
LIBRARIES = {"gifti": "nibabel", "freesurfer": "nibabel", "pyvista, apart": "pyvista"}
# How files of some suffixes begin.
BEGINNINGS = {
    b"ply": (".ply",),
    b"solid": (".stl",),
    b"OFF": (".off",),
    b"glTF": (".glb",),
    b"# vtk": (".vtk",),
    b"<VTKFile": (".vtp", ".vtu"),
    b"<?xml": (".gii", ".vtp", ".vtu"),
    b"PK": (".3mf",),
    b"\x89HDF": (".vtkhdf",),
    b"$MeshFormat": (".msh",),
}
WORDS = 200  # the most characters of another library's message
# Exit status of the process that reads apart, where it tells why it could not.
FAILED = 3
# The most seconds that it takes: some, and more for a large file, a hundredth of usual speed.
SECONDS, BYTES_A_SECOND = 60.0, 1e6


def read_arrays(path):
    """Vertices, faces and normals (or None) of a file, as `curvlib.read` says."""
    path = Path(path).expanduser()
    if path.is_dir():
        raise InputError(f"{str(path)!r} is a folder; name a file in it")
    if not path.is_file():
        near = get_close_matches(path.name, _siblings(path), n=1)
        hint = f"; did you mean {str(path.with_name(near[0]))!r}?" if near else ""
        raise InputError(f"{str(path)!r}: no such file{hint}")
    reader = SUFFIXES.get(path.suffix.lower())
    if reader is None:
        known = ", ".join(sorted(SUFFIXES))
        raise InputError(f"{str(path)!r}: cannot tell its format by its suffix; known: {known}")
    library = LIBRARIES.get(reader, reader)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            vertices, faces, normals = READERS[reader](path)
    except ImportError as error:
        raise InputError(
            f"{str(path)!r}: reading {path.suffix} needs {error.name or library}: "
            "install curvlib[files]"
        ) from None
    except InputError as error:
        raise InputError(f"{str(path)!r}: cannot read it: {error}{_other_format(path)}") from None
    except Exception as error:
        words = " ".join(str(error).split())[:WORDS] or type(error).__name__
        raise InputError(
            f"{str(path)!r}: {library} cannot read it: {words}{_other_format(path)}"
        ) from None
    if not len(faces):
        raise InputError(f"{str(path)!r}: there are no triangles in it{_other_format(path)}")
    return np.asarray(vertices), np.asarray(faces), normals


def _other_format(path):
    """Words for a file that does not begin as its suffix says, else nothing."""
    with path.open("rb") as file:
        start = file.read(16)
    usual = next((own for begin, own in BEGINNINGS.items() if start.startswith(begin)), None)
    if usual is None or path.suffix.lower() in usual:
        return ""
    return f"; it begins as a {usual[0]} file does"


def _siblings(path):
    return [p.name for p in path.parent.iterdir()] if path.parent.is_dir() else []


def _curvlib(path):
    data = path.read_bytes().removeprefix(b"\xef\xbb\xbf")  # a mark that editors put before text
    return OURS[path.suffix.lower()](data)


def _trimesh(path):
    import trimesh

    # As it stands: by default points are merged and normals made.
    mesh = trimesh.load_mesh(path, process=False)
    normals = mesh._cache["vertex_normals"]  # None where the file has none
    same = normals is not None and len(normals) == len(mesh.vertices)
    return mesh.vertices, mesh.faces, np.array(normals, float) if same else None


def _pyvista(path):
    import pyvista

    with pyvista.vtk_verbosity("off"), _heard() as told:
        data = pyvista.read(path)
    if told and not data.n_cells:
        raise RuntimeError(told[0])
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


@contextmanager
def _heard():
    """The list of what pyvista logs meanwhile of VTK's errors, which would go to stderr."""
    told, handler, root = [], logging.Handler(), logging.getLogger()
    handler.emit = lambda record: told.append(record.getMessage())
    root.addHandler(handler)
    try:
        yield told
    finally:
        root.removeHandler(handler)


def _pyvista_apart(path):
    """As `_pyvista`, in a process of its own: broken files of these formats end it, by a fault of
    VTK or by meshio, have HDF5 write to stderr, or never end."""
    if find_spec("pyvista") is None:
        raise ImportError(name="pyvista")
    limit = SECONDS + path.stat().st_size / BYTES_A_SECOND
    try:
        apart = subprocess.run(
            [sys.executable, "-m", __name__, str(path)],
            env=os.environ | {"PYTHONPATH": os.pathsep.join(map(str, sys.path))},
            capture_output=True,
            timeout=limit,
        )
    except subprocess.TimeoutExpired:
        raise RuntimeError(f"it did not end within {limit:.0f} s, and was stopped") from None
    if apart.returncode == FAILED:
        raise RuntimeError(apart.stdout.decode("utf-8", "replace"))
    if apart.returncode:
        raise RuntimeError("it is broken, and ends the reader")
    arrays = np.load(io.BytesIO(apart.stdout))
    return arrays["vertices"], arrays["faces"], arrays.get("normals")


def _gifti(path):
    import nibabel

    image = nibabel.load(path)
    return *(image.agg_data(name) for name in ("pointset", "triangle")), None


def _freesurfer(path):
    import nibabel

    return *nibabel.freesurfer.read_geometry(path)[:2], None


READERS = {
    "curvlib": _curvlib,
    "trimesh": _trimesh,
    "pyvista": _pyvista,
    "pyvista, apart": _pyvista_apart,
    "gifti": _gifti,
    "freesurfer": _freesurfer,
}


def _apart():
    """What the process of `_pyvista_apart` does: arrays to stdout, else words and FAILED."""
    out = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # VTK may print
    try:
        vertices, faces, normals = _pyvista(Path(sys.argv[1]))
    except (Exception, SystemExit) as error:
        ended = isinstance(error, SystemExit)  # by meshio
        out.write(b"meshio cannot either" if ended else str(error).encode())
        out.close()
        sys.exit(FAILED)
    given = {} if normals is None else {"normals": normals}
    np.savez(out, vertices=vertices, faces=faces, **given)
    out.close()


if __name__ == "__main__":
    _apart()
