"""The library of meshes on disk: one HDF5 file per surface, one text file per mesh.

In the HDF5 file the group /<diagonal>/<n> holds the mesh of resolution n as vertices, faces,
uv, normals, K, H, H2, k1, k2, smooth and boundary. The text file is the one that the paper
describes: x y z K H^2 for every vertex, a line each.
"""

import os
from collections.abc import Mapping
from contextlib import contextmanager
from pathlib import Path

import numpy as np

from .errors import InputError, check_name
from .mesh import FIELDS, Mesh
from .nurbs import Surface
from .tessellation import tessellate

CONVENTIONS = (
    "Values are exact at the vertices, pointwise; lengths in the unit of the mesh, K in "
    "1/length^2, H in 1/length; H > 0 where the surface bends away from its outward normal; NaN "
    "where the surface is not C^2"
)


def write_library(surface: Surface, meshes, path) -> None:
    """Tessellate a surface and write its file and, in a folder of its name, its text files.

    `meshes`: the (diagonal, n) to make. `path` ends in <surface>.h5. Nothing is left behind if
    writing fails.
    """
    import h5py

    path = Path(path)
    texts = path.with_suffix("")
    texts.mkdir(parents=True, exist_ok=True)
    with whole_file(path) as part, h5py.File(part, "w") as file:
        file.attrs["surface"] = surface.name
        file.attrs["label"] = surface.label
        file.attrs["conventions"] = CONVENTIONS
        for diagonal, n in meshes:
            mesh = tessellate(surface, n, diagonal)
            _write_mesh(file.create_group(f"{diagonal}/{n}"), mesh)
            with whole_file(texts / text_name(diagonal, n)) as text:
                _write_text(text, surface, n, diagonal, mesh)


def text_name(diagonal: str, n: int) -> str:
    """Name of a mesh's text file in the folder of its surface."""
    return f"{diagonal}-{n:03d}.txt"


def load_library(*paths) -> "Library":
    """The meshes in a library's folder or in single files of it; no mesh is read yet.

    Raises InputError where there is no library or a file of it cannot be read.
    """
    files = []
    for path in map(Path, paths):
        found = sorted(path.glob("*.h5")) if path.is_dir() else [path] if path.exists() else []
        if not found:
            raise InputError(f"{path}: no library here; `snakemake` makes one in data/library")
        files += found
    return Library(files)


class Library(Mapping):
    """Meshes by (surface, diagonal, n); each is read when it is asked for."""

    def __init__(self, files):
        self._files = {}
        for path in files:
            with open_hdf5(path) as file:
                surface = file.attrs.get("surface")
                if surface is None:
                    raise InputError(f"{path}: an HDF5 file, but not one of a mesh library")
                keys = [(surface, d, n) for d in file for n in sorted(int(n) for n in file[d])]
            self._files.update(dict.fromkeys(keys, path))

    def __iter__(self):
        return iter(self._files)

    def __len__(self):
        return len(self._files)

    def __getitem__(self, key) -> Mesh:
        _, diagonal, n = key
        with open_hdf5(self._files[key]) as file:
            group = file[f"{diagonal}/{n}"]
            fields = {name: group[name][()] for name in FIELDS}
            fields["smooth"] = fields["smooth"].astype(bool)
            return Mesh(group["vertices"][()], group["faces"][()], **fields)

    def mesh(self, surface: str, n: int, diagonal: str = "same") -> Mesh:
        """The mesh of a surface at resolution n; InputError, with the nearest, if there is none."""
        check_name("surface", surface, self.surfaces())
        check_name("diagonal", diagonal, {d for s, d, _ in self if s == surface})
        valid = [str(m) for s, d, m in self if (s, d) == (surface, diagonal)]
        check_name("resolution", str(n), valid)
        return self[surface, diagonal, n]

    def surfaces(self) -> list[str]:
        """Names of the surfaces, sorted."""
        return sorted({surface for surface, _, _ in self})


@contextmanager
def whole_file(path):
    """A path to write to that becomes `path` at the end, or is removed on an error."""
    path = Path(path)
    part = path.with_name(path.name + ".part")
    try:
        yield part
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


@contextmanager
def open_hdf5(path):
    """A file open for reading; InputError, naming it, where it is cut off or no HDF5."""
    import h5py

    try:
        file = h5py.File(path, "r")
    except OSError as error:
        reason = "missing" if isinstance(error, FileNotFoundError) else "cut off or not HDF5"
        raise InputError(f"{path}: {reason}; delete it and run snakemake again") from None
    with file:
        yield file


def _write_mesh(group, mesh):
    arrays = {"vertices": mesh.vertices, "faces": mesh.faces.astype(np.int32)}
    arrays |= {name: getattr(mesh, name) for name in FIELDS}
    arrays |= {"H2": mesh.H**2, "boundary": mesh.boundary}
    for name, array in arrays.items():
        array = array.astype(np.uint8) if array.dtype == bool else array
        group.create_dataset(name, data=array, compression="gzip", compression_opts=4, shuffle=True)


def _write_text(path, surface, n, diagonal, mesh):
    header = (
        f"{surface.label}, {n} x {n} cells, diagonal {diagonal}, {len(mesh.faces)} triangles, "
        f"{len(mesh.vertices)} vertices\n{CONVENTIONS}\nx y z K H^2"
    )
    rows = np.column_stack((mesh.vertices, mesh.K, mesh.H**2))
    np.savetxt(path, rows, fmt="%.17g", header=header)
