"""The library of meshes: a folder per surface, three files per mesh; or the archive of it.

`<surface>/<surface>.<diagonal>.<n>` is the mesh of n x n cells: `.vtkhdf` with all that is
known at its vertices, from which it is loaded, `.ply` and `.txt` with K and H^2.
"""

import os
from collections.abc import Mapping
from pathlib import Path, PurePosixPath

from curvlib.errors import InputError, check_name
from curvlib.files import open_archive, open_hdf5, place_of
from curvlib.meshes.mesh import Mesh

from .formats import read_vtkhdf

# One file of each per mesh; it is loaded from the first.
KINDS = (".vtkhdf", ".ply", ".txt")


def mesh_files(surface: str, diagonal: str, n: int) -> list[str]:
    """The files of a mesh, relative to the library's folder; the one it is loaded from first."""
    return [f"{surface}/{surface}.{diagonal}.{n:03d}{kind}" for kind in KINDS]


def nurbs_file(surface: str) -> str:
    """The file of a surface, relative to the library's folder."""
    return f"{surface}/{surface}.json"


def load_library(*paths) -> "Library":
    """The meshes in a library's folder, in its archive or in single files; none is read yet.

    Raises InputError where there is no library. What is wrong with a file is told when its mesh
    is asked for.
    """
    files = {}
    for path in map(Path, paths):
        found = dict(_meshes(path))
        if not found:
            raise InputError(
                f"{path}: no mesh library here; `curvlib fetch` gets one, `snakemake` makes one "
                "in data/library"
            )
        files |= found
    return Library(files)


class Library(Mapping):
    """Meshes by (surface, diagonal, n); each is read when it is asked for."""

    def __init__(self, files: dict):
        """`files`: for every key the path of its .vtkhdf, or the archive's and the member."""
        self._files = files

    def __iter__(self):
        return iter(self._files)

    def __len__(self):
        return len(self._files)

    def __getitem__(self, key) -> Mesh:
        """The mesh; InputError, naming the file, where that is cut off or no such mesh."""
        path, member = self._files[key]
        with open_hdf5(path, member) as file:
            try:
                return read_vtkhdf(file)
            except (KeyError, OSError) as error:
                where = place_of(path, member)
                raise InputError(f"{where}: not a mesh of a library ({error})") from None

    def mesh(self, surface: str, n: int, diagonal: str = "same") -> Mesh:
        """The mesh of a surface at resolution n; InputError, with the nearest, if there is none."""
        self._check((surface, diagonal, n))
        return self[surface, diagonal, n]

    def surfaces(self) -> list[str]:
        """Names of the surfaces, sorted."""
        return sorted({surface for surface, _, _ in self})

    def only(self, keys) -> "Library":
        """The library of these (surface, diagonal, n), in this order; InputError as in `mesh`."""
        for key in keys:
            self._check(key)
        return Library({key: self._files[key] for key in keys})

    def _check(self, key):
        surface, diagonal, n = key
        if key not in self._files:
            where = os.path.commonpath([os.path.abspath(path) for path, _ in self._files.values()])
            check_name("surface", surface, self.surfaces(), where)
            of_surface = [(d, m) for s, d, m in self if s == surface]
            check_name("diagonal", diagonal, sorted({d for d, _ in of_surface}), where)
            valid = [str(m) for d, m in of_surface if d == diagonal]
            check_name("resolution", str(n), valid, f"{where}, {surface}, diagonal {diagonal}")


def _meshes(path):
    """Yield ((surface, diagonal, n), (path, member or None)) of a folder, archive or file."""
    if path.is_dir():
        files = [(file, file, None) for file in path.glob("*/*.vtkhdf")]
    elif path.suffix == ".zip" and path.exists():
        with open_archive(path) as archive:
            files = [(PurePosixPath(m), path, m) for m in archive.namelist()]
    else:
        files = [(path, path, None)] if path.exists() else []
    for name, *place in sorted(files):
        surface, *key = name.stem.rsplit(".", 2)
        if name.suffix == ".vtkhdf" and len(key) == 2 and key[1].isdecimal():
            yield (surface, key[0], int(key[1])), tuple(place)
