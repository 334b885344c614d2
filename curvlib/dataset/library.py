"""The library of meshes: a folder per surface, three files per mesh; or an archive of it.

`<surface>/<surface>.<diagonal>.<n>` is the mesh of n x n cells: `.vtkhdf`, with all exact values,
is loaded; `.ply` and `.txt` hold K and H^2 for other programs.
"""

import os
from collections.abc import Iterable, Mapping
from functools import cached_property
from numbers import Integral
from pathlib import PurePosixPath

from curvlib.errors import InputError, check_name
from curvlib.files import expanded, no_such_file, open_archive, open_hdf5
from curvlib.meshes.key import MeshKey
from curvlib.meshes.mesh import Mesh

from .sums import check_unchanged
from .vtkhdf import read_vtkhdf

# Files of a mesh; the first is loaded.
KINDS = (".vtkhdf", ".ply", ".txt")


def mesh_files(surface: str, diagonal: str, n: int) -> list[str]:
    """The files of a mesh, relative to the library's folder; the first is loaded."""
    return [f"{surface}/{surface}.{diagonal}.{n:03d}{kind}" for kind in KINDS]


def nurbs_file(surface: str) -> str:
    """The file of a surface, relative to the library's folder."""
    return f"{surface}/{surface}.json"


def load_library(*paths: str | os.PathLike) -> "Library":
    """List the meshes of a library; each is read on access.

    Parameters
    ----------
    *paths : path
        The library's folder, its archive (.zip) or single .vtkhdf files of it. For a mesh in two
        of them, the later path counts.

    Returns
    -------
    Library
        Meshes by (surface, diagonal, n).

    Raises
    ------
    InputError
        A path does not exist or holds no mesh. A damaged file is reported on access.

    Examples
    --------
    >>> import tempfile
    >>> import curvlib
    >>> from curvlib.dataset.write import write_library
    >>> folder = tempfile.TemporaryDirectory()
    >>> write_library(curvlib.surface("sphere"), [("same", 8), ("same", 12)], folder.name)
    >>> library = curvlib.load_library(folder.name)
    >>> library
    <Library of 2 meshes>
      surfaces: sphere
      diagonals: same
      n: 8, 12
    >>> mesh = library.mesh("sphere", 12)
    >>> mesh.vertices.shape, mesh.K.shape
    ((134, 3), (134,))
    >>> folder.cleanup()
    """
    files = {}
    for path in map(expanded, paths):
        try:
            exists = path.exists()
        except OSError as error:  # no permission, or too long a name
            raise InputError(f"{path}: {error.strerror}") from None
        found = dict(_meshes(path)) if exists else {}
        if not found:
            reason = f"{path}: no mesh library here" if exists else no_such_file(path)
            raise InputError(
                f"{reason}; `curvlib fetch` gets a library, `snakemake` makes one in data/library"
            )
        files |= found
    return Library(files)


class Library(Mapping):
    """Meshes with exact curvature by MeshKey, as `load_library` finds them.

    A read-only mapping: `library[surface, diagonal, n]` reads a mesh and raises KeyError where
    there is none; `library.mesh` names the nearest one instead. No mesh is kept in memory.

    Parameters
    ----------
    files : dict
        MeshKey -> (path, None) of a .vtkhdf file, or (path, member) of an archive.
    """

    def __init__(self, files: dict):
        self._files = files

    def __iter__(self):
        return iter(self._files)

    def __len__(self):
        return len(self._files)

    def __contains__(self, key):
        return key in self._files

    def __getitem__(self, key) -> Mesh:
        path, member = self._files[key]
        with open_hdf5(path, member) as file:
            mesh = read_vtkhdf(file)
        if member is None:
            check_unchanged(path)
        return mesh

    def __repr__(self):
        lines = [f"<Library of {len(self)} mesh{'' if len(self) == 1 else 'es'}>"]
        for name, values in zip(("surfaces", "diagonals", "n"), zip(*self)):
            lines.append(f"  {name}: {', '.join(map(str, sorted(set(values))))}")
        return "\n".join(lines)

    def mesh(self, surface: str, n: int, diagonal: str = "same") -> Mesh:
        """Read the mesh of a surface.

        Parameters
        ----------
        surface : str
            Name of the surface, one of `surfaces()`.
        n : int
            Resolution: the mesh has n x n cells of two triangles, of one at a pole.
        diagonal : str
            How the cells are cut: "same", "alternate", "shortest", "random-<seed>" or
            "jittered-<seed>".

        Returns
        -------
        Mesh
            `vertices` (V, 3) in the surface's unit of length, `faces` (F, 3) counter-clockwise
            seen from outside, exact pointwise `K` (V,) in 1/length^2 and `H` (V,) in 1/length
            with H > 0 where the surface bends away from its outward normal, NaN where the surface
            is not C^2; also `k1`, `k2`, `d1`, `d2`, `normals`, `uv`, `smooth`, `pole`,
            `boundary`.

        Raises
        ------
        InputError
            The library has no such mesh (the message has the nearest name), or its file is damaged.

        Examples
        --------
        >>> import tempfile
        >>> import curvlib
        >>> from curvlib.dataset.write import write_library
        >>> folder = tempfile.TemporaryDirectory()
        >>> write_library(curvlib.surface("sphere"), [("same", 8)], folder.name)
        >>> library = curvlib.load_library(folder.name)
        >>> float(abs(library.mesh("sphere", 8).H - 1).max()) < 1e-12
        True
        >>> folder.cleanup()
        """
        self._check((surface, diagonal, n))
        return self[surface, diagonal, n]

    def surfaces(self) -> list[str]:
        """Names of the surfaces, sorted."""
        return sorted({surface for surface, _, _ in self})

    def only(self, keys: Iterable[tuple[str, str, int]]) -> "Library":
        """The library of these (surface, diagonal, n), in this order; raises as `mesh` does."""
        keys = list(keys)
        for key in keys:
            self._check(key)
        return Library({MeshKey(*key): self._files[*key,] for key in keys})

    @cached_property
    def _place(self):
        """Where the files lie, for messages."""
        if not self._files:
            return "empty library"
        return os.path.commonpath([os.path.abspath(path) for path, _ in self._files.values()])

    def _check(self, key):
        """Raise InputError, with the nearest name, unless the library has this mesh."""
        try:
            surface, diagonal, n = key
        except (TypeError, ValueError):
            raise InputError(
                f"{self._place}: a mesh is (surface, diagonal, n), not {key!r}"
            ) from None
        if not isinstance(n, Integral):
            raise InputError(f"{self._place}: n is an int, not {n!r}")
        names = isinstance(surface, str) and isinstance(diagonal, str)
        if names and (surface, diagonal, n) in self:
            return
        check_name("surface", surface, self.surfaces(), self._place)
        of_surface = [(d, m) for s, d, m in self if s == surface]
        check_name("diagonal", diagonal, sorted({d for d, _ in of_surface}), self._place)
        valid = [str(m) for d, m in of_surface if d == diagonal]
        where = f"{self._place}, {surface}, diagonal {diagonal}"
        check_name("resolution", str(n), valid, where)


def _meshes(path):
    """Yield (MeshKey, (path, member or None)) of a folder, archive or file."""
    if path.is_dir():
        files = [(file, file, None) for file in path.glob("*/*.vtkhdf")]
    elif path.suffix == ".zip":
        with open_archive(path) as archive:
            files = [(PurePosixPath(m), path, m) for m in archive.namelist()]
    else:
        files = [(path, path, None)]
    for name, *place in sorted(files):
        surface, *key = name.stem.rsplit(".", 2)
        if name.suffix == ".vtkhdf" and len(key) == 2 and key[1].isdecimal():
            yield MeshKey(surface, key[0], int(key[1])), tuple(place)
